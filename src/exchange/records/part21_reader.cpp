#include "part21_reader.hpp"

#include <limits>

#include "base/say.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kDeepest = 64;  // lists in lists; schemas have three or four

}  // namespace

void Part21Reader::read() {
  if (x_.text_.size() >= std::numeric_limits<std::uint32_t>::max())
    throw InputError("STEP file",
                     {{"", tr("more than 4 GB"), tr("a smaller file"), "range"}});
  try {
    sections();
  } catch (const SyntaxError& e) {
    fault(e.at, e.got, e.expected);
  }
  throw_faults();
  index_ids();
  resolve();
  throw_faults();
  index_users();
}

void Part21Reader::sections() {
  if (x_.text_.starts_with("\xef\xbb\xbf")) lex_.skip(3);  // a byte order mark
  const auto begin = lex_;
  if (lex_.keyword() != "ISO-10303-21")
    begin.refuse(tr("ISO-10303-21; at the beginning"));
  lex_.expect(';', to_translate("behind ISO-10303-21"));
  for (bool data = false;;) {
    const auto name = lex_.keyword();
    if (name == "END-ISO-10303-21" && data) return;
    if (name == "DATA" && lex_.take('(')) parameters();
    if (name.empty() || name.starts_with("END"))
      lex_.refuse(data ? tr("END-ISO-10303-21; or a section") : tr("a section DATA"));
    if (!lex_.take(';')) lex_.refuse(say("; behind {}", name));
    if (name == "HEADER") {
      records([this] { record(), lex_.expect(';', to_translate("behind a record")); },
              name);
      x_.header_records_ = x_.records_.size();
    } else if (name == "DATA") {
      data = true;
      records([this] { instance(); }, name);
    } else {
      records([this] { lex_.skip_record(); }, name);
    }
  }
}

template <class One>
void Part21Reader::records(const One& one, std::string_view section) {
  while (!ended_section(section)) {
    try {
      one();
    } catch (const SyntaxError& e) {
      fault(e.at, e.got, e.expected);
      lex_.skip_record();
    }
  }
}

bool Part21Reader::ended_section(std::string_view section) {
  if (lex_.peek() == '#') return false;
  const auto before = lex_;
  const auto word = lex_.keyword();
  if (word == "ENDSEC") return lex_.expect(';', to_translate("behind ENDSEC")), true;
  lex_ = before;
  if (lex_.ended() || word == "DATA" || word == "HEADER" || word == "END-ISO-10303-21")
    lex_.refuse(say("ENDSEC; at the end of the section {}", section));
  return false;
}

void Part21Reader::instance() {
  Exchange::InstanceEntry entry{.at = static_cast<std::uint32_t>(lex_.at())};
  entry.first = static_cast<std::uint32_t>(x_.records_.size());
  lex_.expect('#', to_translate("and a number, the name of an instance"));
  entry.id = lex_.id();
  lex_.expect('=', to_translate("behind the name of an instance"));
  if (lex_.take('(')) {
    do record();
    while (!lex_.take(')'));
  } else {
    record();
  }
  lex_.expect(';', to_translate("behind an instance"));
  const auto end = static_cast<std::uint32_t>(x_.records_.size());
  entry.size = end - entry.first;
  const auto index = static_cast<std::uint32_t>(x_.instances_.size());
  for (auto i = entry.first; i < end; ++i) {
    auto& same = x_.by_name_[x_.records_[i].name];
    if (same.empty() || same.back() != index) same.push_back(index);
  }
  x_.instances_.push_back(entry);
}

void Part21Reader::record() {
  const auto name = lex_.keyword();
  if (name.empty()) lex_.refuse(tr("the name of an entity"));
  lex_.expect('(', to_translate("behind an entity's name"));
  const auto [first, size] = parameters();
  x_.records_.push_back({.name = name, .first = first, .size = size});
}

/// Values behind "(" up to its ")"; lists in it are kept on a stack of our own, so that
/// the text does not set the depth of ours.
std::pair<std::uint32_t, std::uint32_t> Part21Reader::parameters() {
  scratch_.clear();
  frames_.assign(1, {});
  for (;;) {
    while (opens()) {
    }
    const bool empty = scratch_.size() == frames_.back().begin;
    if (!empty || lex_.peek() != ')') scratch_.push_back(value());
    while (!lex_.take(',')) {
      lex_.expect(')', to_translate("or , behind a parameter"));
      const Value list = closed();
      if (frames_.empty()) return {static_cast<std::uint32_t>(list.index), list.size};
      scratch_.push_back(list);
    }
  }
}

bool Part21Reader::opens() {
  const bool list = lex_.take('(');
  const auto type = list ? std::string_view() : lex_.keyword();
  if (!list && type.empty()) return false;
  if (!list) lex_.expect('(', to_translate("behind a type's name"));
  if (frames_.size() > kDeepest) lex_.refuse(tr("lists in lists of at most 64 levels"));
  frames_.push_back({.begin = scratch_.size(), .typed = !list});
  if (!list) {
    Value name(ValueKind::text, type.size());
    name.at = type.data();
    scratch_.push_back(name);
  }
  return true;
}

Value Part21Reader::closed() {
  const auto frame = frames_.back();
  frames_.pop_back();
  const auto size = scratch_.size() - frame.begin;
  if (frame.typed && size != 2) lex_.refuse(tr("one value of a type"));
  Value list(frame.typed ? ValueKind::typed : ValueKind::list, size);
  list.index = x_.values_.size();
  const auto begin = scratch_.begin() + static_cast<std::ptrdiff_t>(frame.begin);
  x_.values_.insert(x_.values_.end(), begin, scratch_.end());
  scratch_.erase(begin, scratch_.end());
  return list;
}

Value Part21Reader::value() {
  if (lex_.take('$')) return Value();
  if (lex_.take('*')) return Value(ValueKind::derived);
  if (!lex_.take('#')) return lex_.scalar();
  Value v(ValueKind::reference);
  v.index = lex_.id();
  return v;
}

}  // namespace turnwright::exchange
