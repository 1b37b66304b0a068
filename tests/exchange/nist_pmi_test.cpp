// The combined test cases of NIST, cut down to their PMI (tests/data/step/nist), against
// tables made from QIF files and against what the exporting programs say of their own PMI.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "pmi_text.hpp"
#include "step_file.hpp"

namespace turnwright::exchange {
namespace {

struct Nist {
  explicit Nist(int number)
      : text(step_text(fmt::format("nist/ctc_0{}.stp", number))),
        exchange(read_part21(text)),
        pmi(read_pmi(exchange)) {}
  const std::string text;
  const Exchange exchange;
  const Pmi pmi;
};

// Rows of a table without its head, sorted.
std::vector<std::string> table(const std::string& name) {
  std::istringstream in(step_text("nist/" + name));
  std::vector<std::string> rows;
  for (std::string row; std::getline(in, row);) rows.push_back(row);
  if (!rows.empty()) rows.erase(rows.begin());
  std::sort(rows.begin(), rows.end());
  return rows;
}

// A modifier as the tables have it: Creo's QIF files leave out projection and unit areas,
// which NistPmi.ModifiersThatQifLosesAreRead looks at.
std::string qif_modifier(const std::string& modifier) {
  if (modifier.starts_with("lower segment")) return "lower segment";
  const bool lost = modifier.starts_with("projected") || modifier.starts_with("per ");
  return lost ? "" : modifier;
}

// `datums` is what a table says of them: a converter has lost the common datum A-B, and the
// second reader does not see modifiers of datums.
std::string row(const GeometricTolerance& t, bool common, bool datum_modifiers) {
  auto datums = datums_text(t);
  if (!common && datums == "A-B") datums = "";
  while (!datum_modifiers && datums.find('(') != std::string::npos)
    datums.erase(datums.find('('), datums.find(')') - datums.find('(') + 1);
  std::string modifiers;
  for (const auto& m : t.modifiers) modifiers += qif_modifier(m);
  return fmt::format("{},{:.6g},{},{},{}", name(t.symbol), t.width_mm.value_or(NAN),
                     t.diametral ? "diameter" : "", datums, modifiers);
}

std::vector<std::string> tolerance_rows(const Pmi& pmi, int number) {
  std::vector<std::string> rows;
  for (const auto& t : pmi.tolerances) rows.push_back(row(t, number != 5, number != 2));
  std::sort(rows.begin(), rows.end());
  return rows;
}

// Sizes with a tolerance; a converter calls all but diameters and angles widths.
std::vector<std::string> size_rows(const Pmi& pmi) {
  std::vector<std::string> rows;
  const auto add = [&](const std::string& kind, double nominal, double lower,
                       double upper) {
    rows.push_back(fmt::format("{},{:.6g},{:.6g},{:.6g}", kind, nominal, lower, upper));
  };
  for (const auto& d : pmi.dimensions)
    if (d.limits)
      add(d.name == "diameter" ? "diameter" : "width", d.nominal_mm.value_or(NAN),
          d.limits->lower_mm, d.limits->upper_mm);
  constexpr double kDeg = 180 / std::numbers::pi;
  for (const auto& a : pmi.angles)
    if (a.lower_rad && a.upper_rad)
      add("angle", a.nominal_rad.value_or(NAN) * kDeg, *a.lower_rad * kDeg,
          *a.upper_rad * kDeg);
  std::sort(rows.begin(), rows.end());
  return rows;
}

TEST(NistPmi, EveryToleranceIsThatOfTheTable) {
  for (const int number : {1, 2, 3, 4, 5}) {
    const Nist nist(number);
    EXPECT_EQ(tolerance_rows(nist.pmi, number),
              table(fmt::format("ctc_0{}_tolerances.csv", number)))
        << number;
    EXPECT_TRUE(nist.pmi.unread.empty()) << nist.pmi.unread.front().text;
  }
}

TEST(NistPmi, EverySizeWithLimitsIsThatOfTheTable) {
  for (const int number : {1, 2, 3, 5})
    EXPECT_EQ(size_rows(Nist(number).pmi),
              table(fmt::format("ctc_0{}_sizes.csv", number)))
        << number;
}

// The QIF file of CTC-04 has holes one by one and calls some diameters widths.
TEST(NistPmi, SizesOfTheFourthCaseAreInItsTable) {
  std::set<std::string> known;
  const auto numbers = [](const std::string& row) { return row.substr(row.find(',')); };
  for (const auto& row : table("ctc_04_sizes.csv")) known.insert(numbers(row));
  const auto rows = size_rows(Nist(4).pmi);
  EXPECT_EQ(rows.size(), 7u);
  for (const auto& row : rows) EXPECT_TRUE(known.contains(numbers(row))) << row;
}

// The text of a validation property of an instance; "" if it has none of this name.
std::string validation(const Exchange& file, const std::string& at,
                       const std::string& wanted) {
  const auto subject = file.at(std::stoull(at.substr(1)));
  for (const auto& property : subject.users()) {
    if (!property.is("PROPERTY_DEFINITION")) continue;
    for (const auto& relation : property.users()) {
      if (!relation.is("PROPERTY_DEFINITION_REPRESENTATION")) continue;
      const auto shown = relation.record(0)[1].instance().find("REPRESENTATION");
      for (std::size_t i = 0; shown && i < (*shown)[1].size(); ++i) {
        const auto item =
            (*shown)[1][i].instance().find("DESCRIPTIVE_REPRESENTATION_ITEM");
        if (item && (*item)[0].text() == wanted) return (*item)[1].text();
      }
    }
  }
  return "";
}

std::string letters(const GeometricTolerance& t) {
  std::vector<std::string> all;
  for (const auto& d : t.datums)
    all.push_back(fmt::format("{}", fmt::join(d.letters, "-")));
  return all.empty() ? "none" : fmt::format("{}", fmt::join(all, ","));
}

TEST(NistPmi, DatumsAreThoseThatTheExporterNames) {
  std::size_t compared = 0;
  for (const int number : {2, 3, 4}) {
    const Nist nist(number);
    for (const auto& t : nist.pmi.tolerances) {
      const auto named = validation(nist.exchange, t.at, "datum references");
      if (named.empty()) continue;
      EXPECT_EQ(letters(t), named) << number << " " << t.at;
      ++compared;
    }
  }
  EXPECT_EQ(compared, 22u + 13u + 7u);
}

// "DIM\w<diameter>6.65 <plus-minus>0.12": the value as CTC-04's exporter shows it.
TEST(NistPmi, ValuesAreThoseThatTheExporterShows) {
  const Nist nist(4);
  for (const auto& t : nist.pmi.tolerances) {
    const auto shown = validation(nist.exchange, t.at, "equivalent unicode string");
    EXPECT_NE(shown.find(fmt::format("{}", *t.width_mm)), std::string::npos) << shown;
    EXPECT_EQ(shown.find("⌀") != std::string::npos, t.diametral) << shown;
  }
  for (const auto& d : nist.pmi.dimensions) {
    const auto shown = validation(nist.exchange, d.at, "equivalent unicode string");
    EXPECT_NE(shown.find(fmt::format("{}", *d.nominal_mm)), std::string::npos) << shown;
    const auto limit = d.limits ? fmt::format("±{}", d.limits->upper_mm) : "";
    EXPECT_NE(shown.find(limit), std::string::npos) << shown;
    EXPECT_EQ(shown.find('[') != std::string::npos,
              d.notes == std::vector<std::string>{"theoretical"})
        << shown;
  }
}

TEST(NistPmi, NoToleranceIsZero) {
  for (const int number : {1, 2, 3, 4, 5})
    for (const auto& t : Nist(number).pmi.tolerances) EXPECT_GT(t.width_mm, 0) << t.at;
}

TEST(NistPmi, ModifiersThatQifLosesAreRead) {
  const auto has = [](const Pmi& pmi, const std::string& modifier) {
    return std::count_if(
        pmi.tolerances.begin(), pmi.tolerances.end(),
        [&](const auto& t) { return t.modifiers == std::vector<std::string>{modifier}; });
  };
  EXPECT_EQ(has(Nist(3).pmi, "per 6.35 mm rectangular by 6.35 mm"), 1);
  EXPECT_EQ(has(Nist(4).pmi, "projected by 50 mm"), 1);
  std::size_t common = 0;
  for (const auto& t : Nist(5).pmi.tolerances)
    if (t.symbol == Symbol::circular_runout && datums_text(t) == "A-B") ++common;
  EXPECT_EQ(common, 3u);
}

TEST(NistPmi, DatumsHaveTheirLettersAndFaces) {
  const std::vector<std::string> letters{"",       "ABC",      "ABCDEFGHJK",
                                         "ABCDEF", "ABCDEFGH", "ABCD"};
  for (const int number : {1, 2, 3, 4, 5}) {
    std::string found;
    for (const auto& datum : Nist(number).pmi.datums) {
      found += datum.letter;
      EXPECT_TRUE(datum.targets || !datum.of.faces.empty()) << number << datum.letter;
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, letters[static_cast<std::size_t>(number)]);
  }
}

// Every tolerance leads to faces of the file, but those whose feature is an edge (CTC-05's
// straightness) or holes that CTC-04 gives by their axes.
TEST(NistPmi, TolerancesLeadToFaces) {
  for (const int number : {1, 2, 3, 4, 5}) {
    const Nist nist(number);
    for (const auto& t : nist.pmi.tolerances) {
      EXPECT_FALSE(t.of.faces.empty() && t.of.other.empty()) << number << t.at;
      for (const auto& face : t.of.faces)
        EXPECT_TRUE(nist.exchange.at(std::stoull(face.substr(1))).is("ADVANCED_FACE"));
    }
  }
}

TEST(NistPmi, OnlyTwoAnnotationsAreStrokesAlone) {
  const auto pmi = Nist(5).pmi;
  EXPECT_EQ(pmi.annotations, 22u);
  EXPECT_EQ(pmi.strokes_alone, (std::vector<std::string>{"Rectangular Region (14)",
                                                         "Rectangular Region (21)"}));
  EXPECT_TRUE(Nist(1).pmi.strokes_alone.empty());
  EXPECT_EQ(Nist(1).pmi.annotations, 23u);
}

TEST(NistPmi, AttributesOfTheAuthorGiveNumberAndRevision) {
  const auto pmi = Nist(5).pmi;
  EXPECT_EQ(pmi.part_number,
            "NIST PMI CTC 05 ASME1");  // the product's is the file's name
  EXPECT_EQ(pmi.revision, "D");        // the product's is "version 0"
}

}  // namespace
}  // namespace turnwright::exchange
