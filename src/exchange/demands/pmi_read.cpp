#include "pmi_read.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "base/say.hpp"
#include "exchange/records/step_unit.hpp"

namespace turnwright::exchange {
namespace {

constexpr double kDigits = 1e9;      // of a mm
constexpr double kLongest_mm = 1e7;  // no part is as long
constexpr std::size_t kLongestText = 200;

}  // namespace

std::vector<Instance> instances_of(const Exchange& file,
                                   std::initializer_list<std::string_view> names) {
  std::vector<Instance> all;
  for (const auto name : names)
    for (const auto& instance : file.all(name)) all.push_back(instance);
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

Parameter of_last(const Record& record, std::size_t n, std::size_t i) {
  if (record.size() < n)
    record.refuse(say("{} parameters", record.size()), say("at least {}", n));
  return record[record.size() - n + i];
}

std::vector<Instance> references(const Parameter& parameter, std::size_t most) {
  std::vector<Instance> found;
  std::vector<Parameter> waiting{parameter};
  while (!waiting.empty()) {
    const auto next = waiting.back();
    waiting.pop_back();
    if (next.is(ValueKind::reference)) {
      if (found.size() == most) parameter.refuse(say("at most {}", most));
      found.push_back(next.instance());
    } else if (next.is(ValueKind::typed)) {
      waiting.push_back(next.inner());
    } else if (next.is(ValueKind::list)) {
      for (std::size_t i = next.size(); i-- > 0;) waiting.push_back(next[i]);
    }
  }
  return found;
}

std::vector<Instance> representation_items(const Instance& representation,
                                           std::size_t most) {
  const auto whole = representation.find("REPRESENTATION");
  const auto list = (whole ? *whole : representation.record(0))[1];
  auto waiting = references(list, most);
  std::reverse(waiting.begin(), waiting.end());
  std::vector<Instance> found;
  std::set<Instance> opened;  // compound items, which a broken file may nest in a circle
  while (!waiting.empty()) {
    const auto item = waiting.back();
    waiting.pop_back();
    const auto compound = item.find("COMPOUND_REPRESENTATION_ITEM");
    if (!compound) {
      found.push_back(item);
    } else if (opened.insert(item).second) {
      auto inner = references(of_last(*compound, 1, 0), most);
      waiting.insert(waiting.end(), inner.rbegin(), inner.rend());
    }
    if (found.size() + waiting.size() + opened.size() > most)
      list.refuse(say("at most {} items", most));
  }
  return found;
}

double rounded_mm(double x_mm) { return std::round(x_mm * kDigits) / kDigits; }

double length_mm(const Instance& measure) {
  const auto found = step_measure(measure);
  if (!found || found->quantity != Quantity::length)
    measure.record(0).refuse(tr("no length"), tr("a length with its unit"));
  if (!(std::abs(found->value) < kLongest_mm))
    measure.record(0).refuse(tr("10 km or more"), tr("the length of a part"));
  return rounded_mm(found->value);
}

std::string lower_case(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

std::string short_text(const Parameter& parameter) {
  auto text = parameter.short_text();
  if (!text || text->size() > kLongestText) parameter.refuse(tr("at most 200 bytes"));
  return std::move(*text);
}

std::string in_words(const Parameter& enumeration) {
  const auto word = enumeration.word();
  if (word.size() > kLongestText) enumeration.refuse(tr("at most 200 bytes"));
  auto text = lower_case(std::string(word));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

std::string reason(const InputError& error) {
  if (error.problems().empty()) return tr("It cannot be read.");
  const auto& first = error.problems().front();
  const auto shown = [](const std::string& text) { return text.substr(0, kLongestText); };
  return say("It cannot be read: {} is {}, expected {}.", shown(first.pointer),
             shown(first.got), shown(first.expected));
}

}  // namespace turnwright::exchange
