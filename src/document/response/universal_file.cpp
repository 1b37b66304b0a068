#include "universal_file.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "document/json/text_lines.hpp"
#include "measured_response.hpp"

namespace turnwright::document {
namespace {

constexpr const char* kUniversal =
    to_translate("a universal file in ASCII, or the list of its lines");
constexpr std::size_t kMostValues = 100'000, kHeader = 11;
constexpr double kUnread = std::numeric_limits<double>::quiet_NaN();

/// The columns `from` to `from + count`, in characters, of a line in UTF-8.
std::string_view columns(std::string_view line, std::size_t from, std::size_t count) {
  const auto at = [&](std::size_t characters) {
    std::size_t i = 0;
    while (i < line.size() && characters > 0) {
      ++i;
      while (i < line.size() && (line[i] & 0xC0) == 0x80) ++i;
      --characters;
    }
    return i;
  };
  const std::size_t begin = at(from);
  return line.substr(begin, at(from + count) - begin);
}

bool is_delimiter(std::string_view line) { return trimmed(line) == "-1"; }

std::optional<double> fortran_number(std::string_view field) {
  std::string digits(trimmed(field));
  for (char& c : digits)
    if (c == 'D' || c == 'd') c = 'e';
  return csv_number(digits);
}

/// A field of a line: its first column, from 1, and its text.
struct Field {
  std::size_t column;
  std::string_view text;
};

std::vector<Field> fields_of(std::string_view line) {
  std::vector<Field> out;
  for (std::size_t at = 0; (at = line.find_first_not_of(" \t", at)) != line.npos;) {
    const std::size_t end = std::min(line.find_first_of(" \t", at), line.size());
    out.push_back({at + 1, line.substr(at, end - at)});
    at = end;
  }
  return out;
}

/// Fields of the widths, again and again, without those that are blank.
std::vector<Field> of_widths(std::string_view line, std::span<const std::size_t> widths) {
  std::vector<Field> out;
  for (std::size_t at = 0, i = 0; at < line.size(); at += widths[i++ % widths.size()])
    if (const auto text = line.substr(at, widths[i % widths.size()]);
        !trimmed(text).empty())
      out.push_back({at + 1, text});
  return out;
}

/// Numbers in the columns of the format, 0 for blanks, as Fortran reads them; empty if some
/// columns hold no number.
std::vector<double> in_columns(std::string_view line,
                               std::span<const std::size_t> widths) {
  std::vector<double> out;
  for (std::size_t at = 0, i = 0; i < widths.size(); at += widths[i++]) {
    const auto field = at < line.size() ? trimmed(line.substr(at, widths[i])) : "";
    const auto x = field.empty() ? std::optional(0.0) : fortran_number(field);
    if (!x) return {};
    out.push_back(*x);
  }
  return out;
}

/// Lines of one file, one dataset after the other.
class UniversalReader {
 public:
  UniversalReader(const Reader& text, std::vector<TextLine> lines)
      : text_(text), lines_(std::move(lines)) {}

  std::vector<UniversalFunction> functions() && {
    while (true) {
      while (at_ < lines_.size() && !is_delimiter(lines_[at_].text)) ++at_;
      if (at_ + 1 >= lines_.size()) break;
      ++at_;
      const std::size_t first = at_;
      while (at_ < lines_.size() && !is_delimiter(lines_[at_].text)) ++at_;
      if (at_ == lines_.size() && !trimmed(line(first)).starts_with("58b"))
        report(first, shown_line(first), tr("a dataset that ends with a line of -1"),
               "type");
      dataset(first, at_);
      ++at_;
      ++datasets_;
    }
    if (datasets_ == 0)
      text_.problem(tr("no dataset"),
                    tr("datasets of a universal file between lines of -1"), "missing");
    return std::move(out_);
  }

 private:
  std::string_view line(std::size_t i) const { return lines_[i].text; }
  std::string shown_line(std::size_t i) const {
    return shown(std::string(trimmed(line(i))));
  }

  void report(std::size_t i, std::string got, std::string expected, std::string code) {
    text_.problems().add({line_pointer(text_, lines_[i].number), std::move(got),
                          std::move(expected), std::move(code)});
  }

  /// The dataset whose number stands in line `first`, its records up to `end`.
  void dataset(std::size_t first, std::size_t end) {
    const auto number = trimmed(line(first)).substr(0, trimmed(line(first)).find(' '));
    if (number == "58b")
      report(first, tr("a binary dataset 58b"), tr("the ASCII form, dataset 58"), "type");
    else if (number == "58")
      function(first + 1, end);
    else if (number == "164")
      units_ = read_units(first + 1, end);
    else if (const auto n = csv_number(number); !n || *n < 1)
      report(first, shown_line(first), tr("the number of a dataset"), "type");
  }

  /// Numbers of a line: between blanks, or else in the columns of the format.
  std::vector<double> numbers(std::size_t i, std::span<const std::size_t> widths) {
    auto fields = fields_of(line(i));
    const auto readable = [](const Field& f) {
      return fortran_number(f.text).has_value();
    };
    if (!std::ranges::all_of(fields, readable)) {
      auto fixed = of_widths(line(i), widths);
      if (std::ranges::all_of(fixed, readable)) fields = std::move(fixed);
    }
    std::vector<double> out;
    for (const Field& f : fields) {
      const auto x = fortran_number(f.text);
      if (!x)
        report(i, say("{} in column {}", shown(std::string(trimmed(f.text))), f.column),
               tr("a number"), "type");
      out.push_back(x.value_or(kUnread));
    }
    return out;
  }

  /// An integer in fixed columns; 0 for blanks.
  long integer(std::size_t i, std::size_t from, std::size_t width) {
    const auto field = trimmed(columns(line(i), from, width));
    if (field.empty()) return 0;
    const auto x = csv_number(field);
    if (x && std::abs(*x) < 1e10 && std::floor(*x) == *x) return static_cast<long>(*x);
    report(i, say("{} in column {}", shown(std::string(field)), from + 1),
           tr("an integer"), "type");
    return 0;
  }

  std::optional<UniversalUnits> read_units(std::size_t first, std::size_t end) {
    constexpr std::size_t kWidths[] = {25};
    if (end < first + 2) {
      report(first - 1, say("a dataset 164 of {} records", end - first),
             tr("its factors in record 2"), "count");
      return std::nullopt;
    }
    const auto factors = numbers(first + 1, kWidths);
    if (factors.size() >= 2 && factors[0] > 0 && factors[1] > 0)
      return UniversalUnits{factors[0], factors[1]};
    if (std::ranges::none_of(factors, [](double x) { return std::isnan(x); }))
      report(first + 1, shown_line(first + 1),
             tr("factors > 0 of length, force and temperature"), "range");
    return std::nullopt;
  }

  UniversalAxis axis(std::size_t i) {
    UniversalAxis out;
    out.type = static_cast<int>(integer(i, 0, 10));
    out.units = trimmed(columns(line(i), 47, 20));
    if (out.units == "NONE") out.units.clear();
    return out;
  }

  UniversalDof dof(std::size_t i, std::size_t from) {
    UniversalDof out{integer(i, from, 10), static_cast<int>(integer(i, from + 10, 4))};
    if (std::abs(out.direction) > 6)
      report(i, say("{} in column {}", out.direction, from + 11),
             tr("a direction from -6 to 6"), "range");
    return out;
  }

  void function(std::size_t first, std::size_t end) {
    UniversalFunction f;
    f.number = ++functions_;
    f.units = units_;
    if (end < first + kHeader) {
      report(first - 1, say("a dataset 58 of {} records", end - first),
             tr("11 and its values"), "count");
      return;
    }
    f.line = lines_[first].number;
    f.name = trimmed(line(first));
    f.type = static_cast<int>(integer(first + 5, 0, 5));
    f.response = dof(first + 5, 41);
    f.reference = dof(first + 5, 66);
    f.abscissa = axis(first + 7);
    f.ordinate = axis(first + 8);
    f.denominator = axis(first + 9);
    if (f.type == UniversalFunction::kResponse || f.type == UniversalFunction::kCoherence)
      read_values(f, first + 6, first + kHeader, end);
    out_.push_back(std::move(f));
  }

  /// Record 7 of a function.
  struct Form {
    int ordinate;
    std::size_t count;
    bool even;
    double from, step;
    bool complex() const { return ordinate == 5 || ordinate == 6; }
    bool precise() const { return ordinate == 4 || ordinate == 6; }
    std::size_t numbers_each() const { return (complex() ? 2U : 1U) + (even ? 0U : 1U); }
    std::vector<std::size_t> widths() const {
      if (!precise()) return {13};
      if (even) return {20};
      return complex() ? std::vector<std::size_t>{13, 20, 20}
                       : std::vector<std::size_t>{13, 20};
    }
  };

  std::optional<Form> form(std::size_t i) {
    constexpr std::size_t kWidths[] = {10, 10, 10, 13, 13, 13};
    const auto before = problems_of(text_);
    auto x = in_columns(line(i), kWidths);
    if (x.empty()) x = numbers(i, kWidths);
    if (problems_of(text_) > before) return std::nullopt;
    x.resize(6, 0);
    const auto wrong = [&](std::size_t k, const std::string& expected) {
      report(i, say("{} as field {}", number_text(x[k]), k + 1), expected, "range");
    };
    if (x[0] != 2 && x[0] != 4 && x[0] != 5 && x[0] != 6)
      wrong(0, tr("2, 4, 5 or 6, the type of the ordinate"));
    if (!(x[1] >= 1 && x[1] <= kMostValues) || std::floor(x[1]) != x[1])
      wrong(1, tr("1 to 100000 values"));
    if (x[2] != 0 && x[2] != 1) wrong(2, tr("0 or 1, uneven or even spacing"));
    if (x[2] == 1 && !(x[4] > 0)) wrong(4, tr("a step > 0 of the abscissa"));
    if (problems_of(text_) > before) return std::nullopt;
    return Form{static_cast<int>(x[0]), static_cast<std::size_t>(x[1]), x[2] == 1, x[3],
                x[4]};
  }

  void read_values(UniversalFunction& f, std::size_t record_7, std::size_t first,
                   std::size_t end) {
    const auto form = this->form(record_7);
    if (!form) return;
    f.complex = form->complex();
    const auto widths = form->widths();
    const std::size_t each = form->numbers_each(), all = each * form->count;
    std::vector<double> value;  // numbers of the value that is being read
    std::size_t read = 0;
    for (std::size_t i = first; i < end; ++i)
      for (const double x : numbers(i, widths)) {
        if (++read > all) continue;
        value.push_back(x);
        if (value.size() < each) continue;
        add_value(f, *form, value, i);
        value.clear();
      }
    if (read != all)
      report(std::min(end, lines_.size() - 1), say("{} numbers", read),
             say("{}, {} for each of {} values", all, each, form->count), "count");
  }

  void add_value(UniversalFunction& f, const Form& form, const std::vector<double>& value,
                 std::size_t i) {
    const std::size_t y = form.even ? 0 : 1;
    const double x =
        form.even ? form.from + form.step * static_cast<double>(f.x.size()) : value[0];
    if (!f.x.empty() && x <= f.x.back())
      report(i, say("the abscissa {}", number_text(x)),
             say("more than {} of the value before", number_text(f.x.back())), "order");
    f.x.push_back(x);
    f.y.emplace_back(value[y], form.complex() ? value[y + 1] : 0);
    f.lines.push_back(lines_[i].number);
  }

  const Reader& text_;
  std::vector<TextLine> lines_;
  std::size_t at_ = 0, datasets_ = 0, functions_ = 0;
  std::optional<UniversalUnits> units_;
  std::vector<UniversalFunction> out_;
};

}  // namespace

std::string text_of(const UniversalDof& dof) {
  constexpr const char* kNames[] = {"", "X", "Y", "Z", "RX", "RY", "RZ"};
  const int axis = std::abs(dof.direction);
  const std::string node = std::to_string(dof.node);
  if (axis == 0 || axis > 6) return node;
  return node + (dof.direction < 0 ? "-" : "+") + kNames[axis];
}

std::vector<UniversalFunction> read_universal_file(const Reader& text) {
  auto lines = text_lines(text, kUniversal);
  if (text.broken() || lines.empty()) return {};
  const bool binary = std::ranges::any_of(
      lines, [](const TextLine& line) { return trimmed(line.text).starts_with("58b "); });
  if (!binary && !are_text(text, lines, kUniversal)) return {};
  return UniversalReader(text, std::move(lines)).functions();
}

}  // namespace turnwright::document
