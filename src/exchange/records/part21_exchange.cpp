#include <fmt/format.h>

#include <algorithm>

#include "base/say.hpp"
#include "part21_reader.hpp"
#include "turnwright/base/errors.hpp"
#include "turnwright/exchange/part21.hpp"

namespace turnwright::exchange {
namespace {

std::string_view text_of(const Value& v) { return {v.at, v.size}; }

}  // namespace

std::string name_of(Id id) { return fmt::format("#{}", id); }

Exchange::Exchange(std::string_view text) : text_(text) { Part21Reader(*this).read(); }

Exchange read_part21(std::string_view text) { return Exchange(text); }

std::optional<Record> Exchange::header(std::string_view name) const {
  for (std::size_t i = 0; i < header_records_; ++i)
    if (records_[i].name == name) return Record(*this, records_[i], std::nullopt);
  return std::nullopt;
}

std::optional<Instance> Exchange::find(Id id) const {
  const auto at =
      std::lower_bound(by_id_.begin(), by_id_.end(), id,
                       [this](std::uint32_t i, Id x) { return instances_[i].id < x; });
  if (at == by_id_.end() || instances_[*at].id != id) return std::nullopt;
  return Instance(*this, *at);
}

Instance Exchange::at(Id id) const {
  if (const auto found = find(id)) return *found;
  throw InputError("STEP file", {{name_of(id), tr("no such instance"),
                                  tr("a number that the file holds"), "reference"}});
}

std::vector<Instance> Exchange::all(std::string_view name) const {
  std::vector<Instance> out;
  const auto same = by_name_.find(name);
  if (same == by_name_.end()) return out;
  out.reserve(same->second.size());
  for (const auto i : same->second) out.push_back(Instance(*this, i));
  return out;
}

Id Instance::id() const { return exchange_->instances_[index_].id; }

std::size_t Instance::line() const {
  const auto before = exchange_->text_.substr(0, exchange_->instances_[index_].at);
  return 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
}

std::size_t Instance::records() const { return exchange_->instances_[index_].size; }

Record Instance::record(std::size_t n) const {
  const auto& entry = exchange_->instances_[index_];
  return Record(*exchange_, exchange_->records_[entry.first + n], entry.id);
}

std::optional<Record> Instance::find(std::string_view name) const {
  for (std::size_t i = 0; i < records(); ++i)
    if (record(i).name() == name) return record(i);
  return std::nullopt;
}

Record Instance::as(std::string_view name) const {
  if (const auto found = find(name)) return *found;
  record(0).refuse(this->name(), say("an instance of {}", name));
}

std::string Instance::name() const {
  std::string out(record(0).name());
  for (std::size_t i = 1; i < records(); ++i) out.append(1, '+').append(record(i).name());
  return out;
}

std::vector<Instance> Instance::users() const {
  std::vector<Instance> out;
  const auto end = exchange_->first_user_[index_ + 1];
  for (auto i = exchange_->first_user_[index_]; i < end; ++i)
    out.push_back(Instance(*exchange_, exchange_->users_[i]));
  return out;
}

Parameter Record::operator[](std::size_t n) const {
  if (n >= size()) refuse(say("{} parameters", size()), say("{} or more", n + 1));
  return Parameter(*this, n + 1, exchange_->values_[entry_->first + n]);
}

std::string Record::place() const {
  return (id_ ? name_of(*id_) + " " : "") + std::string(name());
}

void Record::refuse(std::string got, std::string expected) const {
  throw InputError("STEP file", {{place(), std::move(got), std::move(expected), "type"}});
}

const Value& Parameter::required(ValueKind kind, std::string_view expected) const {
  if (!is(kind)) refuse(tr(expected));
  return *value_;
}

std::int64_t Parameter::integer() const {
  return required(ValueKind::integer, to_translate("an integer")).integer;
}

double Parameter::real() const {
  if (is(ValueKind::integer)) return static_cast<double>(value_->integer);
  return required(ValueKind::real, to_translate("a number")).real;
}

std::string Parameter::text() const {
  return part21_text(text_of(required(ValueKind::text, to_translate("a string"))));
}

std::optional<std::string> Parameter::short_text() const {
  constexpr std::size_t kLongest = 1000;
  if (absent()) return "";
  const auto encoded = text_of(required(ValueKind::text, to_translate("a string")));
  if (encoded.size() > kLongest) return std::nullopt;
  return part21_text(encoded);
}

std::string_view Parameter::word() const {
  return text_of(required(ValueKind::enumeration, to_translate("a word between dots")));
}

bool Parameter::boolean() const {
  const auto w = is(ValueKind::enumeration) ? word() : std::string_view();
  if (w != "T" && w != "F") refuse(tr(".T. or .F."));
  return w == "T";
}

std::string_view Parameter::binary() const {
  return text_of(required(ValueKind::binary, to_translate("a binary value")));
}

Instance Parameter::instance() const {
  const auto& v =
      required(ValueKind::reference, to_translate("a reference to an instance"));
  return Instance(*record_.exchange_, v.index);
}

Id Parameter::id() const { return instance().id(); }

std::size_t Parameter::size() const {
  return required(ValueKind::list, to_translate("a list")).size;
}

Parameter Parameter::operator[](std::size_t n) const {
  if (n >= size()) refuse(say("a list of at least {}", n + 1));
  return Parameter(record_, number_, record_.exchange_->values_[value_->index + n]);
}

std::string_view Parameter::type() const {
  const auto& v = required(ValueKind::typed, to_translate("a typed value"));
  return text_of(record_.exchange_->values_[v.index]);
}

Parameter Parameter::inner() const {
  const auto& v = required(ValueKind::typed, to_translate("a typed value"));
  return Parameter(record_, number_, record_.exchange_->values_[v.index + 1]);
}

double Parameter::measure() const {
  Parameter p = *this;
  while (p.is(ValueKind::typed)) p = p.inner();  // bounded by the reader's depth
  return p.real();
}

std::string Parameter::place() const {
  return record_.place() + " parameter " + std::to_string(number_);
}

std::string Parameter::shown() const {
  switch (kind()) {
    case ValueKind::omitted:
      return "$";
    case ValueKind::derived:
      return "*";
    case ValueKind::integer:
      return std::to_string(value_->integer);
    case ValueKind::real:
      return tr("a number");
    case ValueKind::text:
      return tr("a string");
    case ValueKind::enumeration:
      return fmt::format(".{}.", word());
    case ValueKind::binary:
      return tr("a binary value");
    case ValueKind::reference:
      return name_of(id()) + " " + instance().name();
    case ValueKind::list:
      return say("a list of {}", size());
    case ValueKind::typed:
      return std::string(type()) + "(..)";
  }
  return "";
}

void Parameter::refuse(std::string expected) const {
  throw InputError("STEP file", {{place(), shown(), std::move(expected), "type"}});
}

}  // namespace turnwright::exchange
