#include "drafted_insert.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "base/say.hpp"
#include "document/json/reader.hpp"
#include "tool_estimates.hpp"

namespace turnwright::document {
namespace {

using catalogue::Insert1832;

constexpr double kPrinted_mm = 0.06;  // makers print sizes to 0.1 mm

bool differs(double a, double b) { return !(std::abs(a - b) <= kPrinted_mm); }

std::string code_of(const Insert1832& insert) {
  try {
    return catalogue::encode_iso1832(insert);
  } catch (const std::domain_error&) {
    return "";
  }
}

// A size that does not say what it is: of the circle if a standard insert has it, else of
// the edge.  No circle of the standard is within 0.06 mm of another one's edge.
double edge_of_size_mm(Insert1832 like, double size_mm) {
  like.edge_length_mm = catalogue::edge_length_mm(like.shape, size_mm);
  return code_of(like).empty() ? size_mm : like.edge_length_mm;
}

std::optional<double> edge_mm(const LibraryTool& t, const Insert1832& like) {
  if (t.L_mm) return t.L_mm;
  if (t.IC_mm) return catalogue::edge_length_mm(like.shape, *t.IC_mm);
  if (t.size_mm) return edge_of_size_mm(like, *t.size_mm);
  return std::nullopt;
}

// What of the library disagrees with the designation, "SC is T, RE is 0.4 mm".
std::string disagreement(const LibraryTool& t, const Insert1832& named) {
  std::string all;
  const auto tell = [&](bool wrong, const std::string& symbol, const std::string& value) {
    if (wrong) all += say("{}{} is {}", all.empty() ? "" : ", ", symbol, value);
  };
  const auto letter = [&](const std::string& symbol, const std::optional<char>& given,
                          char own) {
    if (given) tell(*given != own, symbol, std::string(1, *given));
  };
  letter("SC", t.SC, named.shape);
  letter("TC", t.TC, named.tolerance_class);
  letter(tr("the type"), t.type, named.type);
  if (t.AN_deg)
    tell(*t.AN_deg != named.clearance_deg, "AN", say("{} deg", number_text(*t.AN_deg)));
  if (const auto edge = edge_mm(t, named))
    tell(differs(*edge, named.edge_length_mm), tr("the edge"),
         fmt::format("{:.3f} mm", *edge));
  if (t.S_mm) tell(differs(*t.S_mm, named.thickness_mm), "S", mm_text(*t.S_mm));
  if (t.RE_mm)
    tell(!catalogue::is_corner_of(named, *t.RE_mm), "RE",
         fmt::format("{:.4g} mm", *t.RE_mm));
  return all;
}

std::optional<double> printed_clearance_deg(const PrintedDesignations& printed) {
  if (printed.holder) return printed.holder->clearance_deg;
  if (printed.bar) return printed.bar->clearance_deg;
  if (!printed.insert_letters.empty())
    return catalogue::clearance_of_letter_deg(printed.insert_letters[1]);
  return std::nullopt;
}

double clearance_deg(const DraftSource& from) {
  constexpr double kScrewed_deg = 7;
  const auto& t = from.tool;
  if (t.AN_deg) return *t.AN_deg;
  if (const auto known = printed_clearance_deg(from.printed)) return *known;
  const bool screwed = t.clamping ? t.clamping == 'S' : t.boring;
  from.remarks.assume("/insert",
                      screwed ? tr("The clearance of the insert is not said: C, 7 deg, "
                                   "as usual for screwed inserts and for bars.")
                              : tr("The clearance of the insert is not said: N, 0 deg, "
                                   "as usual for inserts that are not screwed."));
  return screwed ? kScrewed_deg : 0;
}

char tolerance_class(const LibraryTool& t, const PrintedDesignations& printed) {
  return t.TC ? *t.TC : printed.insert_letters.empty() ? 'M' : printed.insert_letters[2];
}

char insert_type(const LibraryTool& t, const PrintedDesignations& printed,
                 double clearance) {
  if (t.type) return *t.type;
  if (!printed.insert_letters.empty()) return printed.insert_letters[3];
  return clearance == 0 ? 'G' : 'T';
}

Insert1832 insert_by_sizes(const DraftSource& from) {
  Insert1832 insert;
  const auto& t = from.tool;
  const std::string& letters = from.printed.insert_letters;
  const char shape = t.SC ? *t.SC : letters.empty() ? ' ' : letters[0];
  const auto corner_deg = catalogue::included_angle_deg(shape);
  if (!corner_deg || !t.RE_mm || !(t.L_mm || t.IC_mm || t.size_mm))
    throw std::domain_error(
        shape == 'R'
            ? tr("A round insert: its edge angle changes with the depth of cut, which no "
                 "model here follows.")
            : tr("Its insert is not said: a designation, or SC, RE and IC or L."));
  insert.shape = shape;
  insert.included_angle_deg = *corner_deg;
  insert.re_mm = *t.RE_mm;
  insert.clearance_deg = clearance_deg(from);
  insert.tolerance_class = tolerance_class(t, from.printed);
  insert.type = insert_type(t, from.printed, insert.clearance_deg);
  insert.thickness_mm = 4.76;  // any, for edge_of_size_mm()
  insert.edge_length_mm = *edge_mm(t, insert);
  if (!t.S_mm)
    from.remarks.assume("/insert",
                        tr("The thickness of the insert is not said: the usual one."));
  insert.thickness_mm = t.S_mm.value_or(usual_thickness_mm(
      insert.edge_length_mm / catalogue::edge_length_mm(shape, 1), insert.clearance_deg));
  return insert;
}

// The corner's inch size where a library has it rounded to thousandths of an inch.
std::optional<double> unrounded_mm(std::optional<double> re_mm, const Insert1832& named) {
  constexpr double kInchPerMetric = (25.4 / 64) / 0.4, kHalfOfThousandth_mm = 0.0127;
  const double inch_mm = kInchPerMetric * named.re_mm;
  return re_mm && std::abs(*re_mm - inch_mm) <= kHalfOfThousandth_mm &&
                 !catalogue::is_corner_of(named, *re_mm)
             ? inch_mm
             : re_mm;
}

DraftedInsert by_designation(LibraryTool t, const Insert1832& named,
                             const DraftRemarks& remarks) {
  if (named.shape == 'R')
    throw std::domain_error(
        tr("A round insert: its edge angle changes with the depth of cut, which no model "
           "here follows."));
  const auto designation = catalogue::encode_iso1832(named);
  DraftedInsert out{catalogue::decode_iso1832(designation), designation, named.re_mm};
  t.RE_mm = unrounded_mm(t.RE_mm, out.insert);
  if (const auto wrong = disagreement(t, out.insert); !wrong.empty())
    remarks.contradict(
        say("The insert is named {}, but {}: the name is taken.", designation, wrong));
  if (t.RE_mm && catalogue::is_corner_of(out.insert, *t.RE_mm)) out.re_mm = *t.RE_mm;
  return out;
}

}  // namespace

DraftedInsert drafted_insert(const DraftSource& from) {
  const auto& [tool, printed, remarks] = from;
  if (!printed.unreadable.empty() ||
      (!tool.insert.empty() && !printed_designations({tool.insert}).insert))
    remarks.contradict(say(
        "{} is no designation of ISO 1832: the insert follows from what else is said.",
        shown(printed.unreadable.empty() ? shortened(tool.insert, 40)
                                         : printed.unreadable)));
  if (printed.insert) return by_designation(tool, *printed.insert, remarks);
  auto insert = insert_by_sizes(from);
  DraftedInsert out{insert, "", insert.re_mm};
  try {
    out.designation = catalogue::encode_iso1832(insert);
    out.insert = catalogue::decode_iso1832(out.designation);
  } catch (const std::domain_error& error) {
    throw std::domain_error(say("No insert of ISO 1832: {}.", error.what()));
  }
  if (!catalogue::is_corner_of(out.insert, out.re_mm)) {
    remarks.assume("/geometry",
                   tr("The corner is that of its code in ISO 1832, not RE."));
    out.re_mm = out.insert.re_mm;
  }
  return out;
}

bool holds(const PrintedDesignations& printed, const DraftedInsert& insert) {
  const auto code = std::lround(10 * insert.insert.edge_length_mm) / 10;
  const auto fits = [&](const auto& holder) {
    return holder && holder->insert_shape == insert.insert.shape &&
           holder->edge_code == code;
  };
  return fits(printed.holder) || fits(printed.bar);
}

}  // namespace turnwright::document
