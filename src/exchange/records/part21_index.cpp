#include <algorithm>
#include <numeric>

#include "base/say.hpp"
#include "part21_reader.hpp"
#include "turnwright/base/errors.hpp"

namespace turnwright::exchange {
namespace {

constexpr std::size_t kListed = 100;  // problems in one answer

}  // namespace

void Part21Reader::index_ids() {
  const auto& all = x_.instances_;
  x_.by_id_.resize(all.size());
  std::iota(x_.by_id_.begin(), x_.by_id_.end(), 0U);
  const auto before = [&all](std::uint32_t a, std::uint32_t b) {
    return std::pair(all[a].id, a) < std::pair(all[b].id, b);
  };
  if (!std::is_sorted(x_.by_id_.begin(), x_.by_id_.end(), before))
    std::sort(x_.by_id_.begin(), x_.by_id_.end(), before);
  for (std::size_t i = 1; i < all.size(); ++i) {
    const auto& entry = all[x_.by_id_[i]];
    if (entry.id == all[x_.by_id_[i - 1]].id)
      fault(entry.at, say("{} a second time", name_of(entry.id)),
            tr("a number for every instance of its own"));
  }
}

/// Entries of lists stand before the parameters of their record, so that those of one
/// record end where its parameters do.
template <class F>
void Part21Reader::each_value(const F& f) {
  std::size_t at = 0;
  for (std::size_t i = 0; i < x_.instances_.size(); ++i) {
    const auto& entry = x_.instances_[i];
    const auto& last = x_.records_[entry.first + entry.size - 1];
    if (i == 0 && entry.first > 0) {
      const auto& header = x_.records_[entry.first - 1];
      at = header.first + header.size;
    }
    for (const std::size_t end = last.first + last.size; at < end; ++at)
      f(x_.values_[at], i);
  }
}

void Part21Reader::resolve() {
  each_value([this](Value& v, std::size_t i) {
    if (v.kind != ValueKind::reference) return;
    if (const auto target = x_.find(v.index)) {
      v.index = target->index();
      return;
    }
    const auto place = x_.instance(i).record(0).place();
    fault(x_.instances_[i].at, say("{} referring to {}", place, name_of(v.index)),
          tr("a reference to an instance that the file holds"));
  });
}

void Part21Reader::index_users() {
  const auto n = x_.instances_.size();
  constexpr auto kNobody = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> last(n, kNobody);
  const auto each_use = [&](const auto& use) {
    std::fill(last.begin(), last.end(), kNobody);
    each_value([&](const Value& v, std::size_t i) {
      const auto user = static_cast<std::uint32_t>(i);
      if (v.kind != ValueKind::reference || last[v.index] == user) return;
      last[v.index] = user;
      use(v.index, user);
    });
  };
  x_.first_user_.assign(n + 1, 0);
  each_use([this](std::size_t used, std::uint32_t) { ++x_.first_user_[used + 1]; });
  std::partial_sum(x_.first_user_.begin(), x_.first_user_.end(), x_.first_user_.begin());
  x_.users_.resize(x_.first_user_.back());
  auto next = x_.first_user_;
  each_use([&](std::size_t used, std::uint32_t user) { x_.users_[next[used]++] = user; });
}

void Part21Reader::fault(std::size_t at, std::string got, std::string expected) {
  if (faults_.size() < kListed)
    faults_.push_back({at, std::move(got), std::move(expected)});
  else
    ++more_faults_;
}

void Part21Reader::throw_faults() {
  if (faults_.empty()) return;
  std::stable_sort(faults_.begin(), faults_.end(),
                   [](const Fault& a, const Fault& b) { return a.at < b.at; });
  std::vector<Problem> problems;
  std::size_t line = 1, counted = 0;
  for (auto& f : faults_) {
    const auto until = x_.text_.substr(counted, f.at - counted);
    line += static_cast<std::size_t>(std::count(until.begin(), until.end(), '\n'));
    counted = f.at;
    problems.push_back({"line " + std::to_string(line), std::move(f.got),
                        std::move(f.expected), "syntax"});
  }
  if (more_faults_)
    problems.push_back({"", say("{} more problems", more_faults_), tr("none"), "syntax"});
  throw InputError("STEP file", std::move(problems));
}

}  // namespace turnwright::exchange
