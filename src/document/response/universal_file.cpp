#include "universal_file.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include "base/say.hpp"
#include "document/json/csv.hpp"
#include "document/json/text_lines.hpp"
#include "measured_response.hpp"
#include "turnwright/base/cancelled.hpp"

namespace turnwright::document {
namespace {

constexpr const char* kUniversal =
    to_translate("a universal file, or the list of its lines");
constexpr const char* kBytes = to_translate(
    "the file as one text, a character from U+0000 to U+00FF for each byte of it");
constexpr std::size_t kMostBytes = 100'000'000, kMostValues = 100'000, kHeader = 11;
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

/// A line, or the bytes of a dataset 58b.
struct FileLine {
  std::size_t number = 0;
  std::string_view text = {};
  std::optional<std::string> bytes = {};
};

/// The line "58b" of a binary dataset: I6,A1,2I6,2I12.
struct BinaryForm {
  double byte_order = 0, number_format = 0, lines = 0, bytes = 0;
  bool valid() const {
    return (byte_order == 1 || byte_order == 2) && number_format == 2 &&
           lines == kHeader && bytes > 0 && bytes <= kMostBytes;
  }
};

bool is_binary(std::string_view line) {
  const auto fields = fields_of(line);
  return !fields.empty() && fields[0].text == "58b";
}

BinaryForm binary_form(std::string_view line) {
  const auto fields = fields_of(line);
  const auto field = [&](std::size_t i) {
    return i < fields.size() ? csv_number(fields[i].text).value_or(0) : 0;
  };
  return {field(1), field(2), field(3), std::floor(field(4))};
}

/// Takes up to `count` bytes from a text in which they stand as characters U+0000 to U+00FF.
std::string taken_bytes(std::string_view& text, std::size_t count) {
  std::string out;
  std::size_t at = 0;
  while (out.size() < count && at < text.size()) {
    const auto c = static_cast<unsigned char>(text[at]);
    if (c < 0x80) {
      out += static_cast<char>(c);
      ++at;
    } else if ((c == 0xC2 || c == 0xC3) && at + 1 < text.size()) {
      out += static_cast<char>((c & 0x03) << 6 | (text[at + 1] & 0x3F));
      at += 2;
    } else {
      break;
    }
  }
  text.remove_prefix(at);
  return out;
}

std::string_view taken_line(std::string_view& text) {
  const auto end = text.find('\n');
  auto line = text.substr(0, end);
  text.remove_prefix(end == text.npos ? text.size() : end + 1);
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

/// Whether the dataset ends here, perhaps behind the end of a line.
bool ends(std::string_view text) {
  for (int lines = 0; lines < 2; ++lines) {
    const auto line = taken_line(text);
    if (!trimmed(line).empty()) return is_delimiter(line);
  }
  return false;
}

/// The bytes of a dataset 58b, as many as its line says or, where it does not end there, as
/// its record 7 has values: pyuff 2.5.6 states half of the bytes of complex doubles.
std::string taken_block(std::string_view& text, const BinaryForm& form,
                        std::string_view record_7) {
  const auto fields = fields_of(record_7);
  const auto field = [&](std::size_t i) {
    return i < fields.size() ? csv_number(fields[i].text).value_or(0) : 0;
  };
  const bool complex = field(0) == 5 || field(0) == 6,
             precise = field(0) == 4 || field(0) == 6, even = field(2) == 1;
  const double y = (precise ? 8 : 4) * (complex ? 2 : 1);
  for (const double bytes : {form.bytes, field(1) * (even ? y : y + (precise ? 8 : 4)),
                             field(1) * (even ? y : y + 4)}) {
    if (!(bytes > 0 && bytes < static_cast<double>(text.size()))) continue;
    leave_if_asked();
    std::string_view rest = text;
    auto block = taken_bytes(rest, static_cast<std::size_t>(bytes));
    if (!ends(rest)) continue;
    text = rest;
    return block;
  }
  return taken_bytes(text, static_cast<std::size_t>(form.bytes));
}

/// The lines of a file, the bytes of each dataset 58b in one of them.
std::vector<FileLine> lines_and_blocks(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  constexpr std::size_t kRecord7 = 6;
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::vector<FileLine> out;
  BinaryForm form;
  std::size_t begin = 0;  // of the lines of a dataset 58b; 0: of none
  while (!text.empty()) {
    if (begin > 0 && out.size() == begin + kHeader) {
      out.push_back({.number = out.size() + 1,
                     .bytes = taken_block(text, form, out[begin + kRecord7].text)});
      begin = 0;
      continue;
    }
    const bool first = !out.empty() && is_delimiter(out.back().text);
    out.push_back({.number = out.size() + 1, .text = taken_line(text)});
    if (!first || !is_binary(out.back().text)) continue;
    const auto announced = binary_form(out.back().text);
    if (!announced.valid()) continue;
    form = announced;
    begin = out.size();
  }
  return out;
}

/// IEEE 754 numbers of the sizes [bytes], again and again.
std::vector<double> decoded(std::string_view bytes, std::span<const std::size_t> sizes,
                            bool big_endian) {
  std::vector<double> out;
  for (std::size_t at = 0, i = 0;; ++i) {
    const std::size_t size = sizes[i % sizes.size()];
    if (at + size > bytes.size()) return out;
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t from = big_endian ? at + k : at + size - 1 - k;
      bits = bits << 8 | static_cast<unsigned char>(bytes[from]);
    }
    out.push_back(size == 8 ? std::bit_cast<double>(bits)
                            : std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    at += size;
  }
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
  UniversalReader(const Reader& text, std::vector<FileLine> lines)
      : text_(text), lines_(std::move(lines)) {}

  std::vector<UniversalFunction> functions() && {
    while (true) {
      while (at_ < lines_.size() && !is_delimiter(lines_[at_].text)) ++at_;
      if (at_ + 1 >= lines_.size()) break;
      ++at_;
      const std::size_t first = at_;
      while (at_ < lines_.size() && !is_delimiter(lines_[at_].text)) ++at_;
      const bool bytes_unknown =
          is_binary(line(first)) && !binary_form(line(first)).valid();
      if (at_ == lines_.size() && !bytes_unknown)
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
      binary_function(first, end);
    else if (number == "58")
      function(first + 1, end, std::nullopt);
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

  void binary_function(std::size_t first, std::size_t end) {
    const BinaryForm form = binary_form(line(first));
    if (!form.valid())
      report(first, shown_line(first),
             say("58b, 1 or 2 (the order of bytes), 2 (IEEE 754), {} (lines), the number "
                 "of bytes",
                 kHeader),
             "type");
    else if (end > first + 1 + kHeader && !lines_[first + 1 + kHeader].bytes)
      report(first, tr("a binary dataset 58b"), tr(kBytes), "type");
    else
      function(first + 1, end, form);
  }

  void function(std::size_t first, std::size_t end,
                const std::optional<BinaryForm>& binary) {
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
      read_values(f, first + 6, first + kHeader, end, binary);
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
    /// Bytes of the numbers of a value; an abscissa may be single among doubles.
    std::vector<std::size_t> sizes(std::size_t bytes) const {
      std::vector<std::size_t> out(numbers_each(), precise() ? 8 : 4);
      if (!even && bytes != count * out.size() * out[0]) out[0] = 4;
      return out;
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

  /// Numbers of a block of bytes.
  std::vector<double> numbers(std::size_t i, const Form& form, const BinaryForm& binary) {
    constexpr double kBig = 2;
    if (!lines_[i].bytes) return {};
    auto out = decoded(*lines_[i].bytes, form.sizes(lines_[i].bytes->size()),
                       binary.byte_order == kBig);
    const auto bad =
        std::ranges::find_if(out, [](double x) { return !std::isfinite(x); });
    if (bad != out.end())
      report(i, say("no finite number in place {} of the bytes", bad - out.begin() + 1),
             tr("a number"), "type");
    return out;
  }

  void read_values(UniversalFunction& f, std::size_t record_7, std::size_t first,
                   std::size_t end, const std::optional<BinaryForm>& binary) {
    const auto form = this->form(record_7);
    if (!form) return;
    f.complex = form->complex();
    const auto widths = form->widths();
    const std::size_t each = form->numbers_each(), all = each * form->count;
    std::vector<double> value;  // numbers of the value that is being read
    std::size_t read = 0;
    for (std::size_t i = first; i < end; ++i)
      for (const double x : binary ? numbers(i, *form, *binary) : numbers(i, widths)) {
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
  std::vector<FileLine> lines_;
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
  const auto plain = text_lines(text, kUniversal);
  if (text.broken() || plain.empty()) return {};
  std::vector<FileLine> lines;
  if (text.is_text())
    lines = lines_and_blocks(text.json().get_ref<const std::string&>());
  else
    for (const TextLine& l : plain) lines.push_back({.number = l.number, .text = l.text});
  const bool binary = std::ranges::any_of(
      lines, [](const FileLine& l) { return l.bytes || is_binary(l.text); });
  if (!binary && !are_text(text, plain, kUniversal)) return {};
  return UniversalReader(text, std::move(lines)).functions();
}

}  // namespace turnwright::document
