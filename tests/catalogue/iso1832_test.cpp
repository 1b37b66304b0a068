#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "turnwright/catalogue/tool.hpp"

namespace turnwright::catalogue {
namespace {

// Dimensions printed in makers' catalogues for these common inserts (handbook values).
// Edge length to 0.1 mm, the printed precision; the others are exact table entries.
struct Known {
  std::string designation;
  double angle_deg, clearance_deg;
  char tolerance_class, type;
  double edge_mm, thickness_mm, re_mm;
};
const Known kKnown[] = {
    {"CNMG 120408", 80, 0, 'M', 'G', 12.9, 4.76, 0.8},
    {"CNMG 120412-PR", 80, 0, 'M', 'G', 12.9, 4.76, 1.2},
    {"CCMT 09T304", 80, 7, 'M', 'T', 9.7, 3.97, 0.4},
    {"CCGT 060202", 80, 7, 'G', 'T', 6.4, 2.38, 0.2},
    {"CNMM 190616", 80, 0, 'M', 'M', 19.3, 6.35, 1.6},
    {"DNMG 150604", 55, 0, 'M', 'G', 15.5, 6.35, 0.4},
    {"DCMT 11T304", 55, 7, 'M', 'T', 11.6, 3.97, 0.4},
    {"DCMT 070204", 55, 7, 'M', 'T', 7.75, 2.38, 0.4},
    {"VBMT 160404", 35, 5, 'M', 'T', 16.6, 4.76, 0.4},
    {"VCGT 110302", 35, 7, 'G', 'T', 11.1, 3.18, 0.2},
    {"TNMG 160408", 60, 0, 'M', 'G', 16.5, 4.76, 0.8},
    {"TPMR 110304", 60, 11, 'M', 'R', 11.0, 3.18, 0.4},
    {"SNMG 120408", 90, 0, 'M', 'G', 12.7, 4.76, 0.8},
    {"WNMG 080408", 80, 0, 'M', 'G', 8.7, 4.76, 0.8},
    {"WNMG 060404", 80, 0, 'M', 'G', 6.5, 4.76, 0.4},
    {"RCMT 1204M0", 0, 7, 'M', 'T', 12.0, 4.76, 6.0},
    {"RNMG 120400", 0, 0, 'M', 'G', 12.7, 4.76, 6.35},
};

TEST(Iso1832, EqualsTheMakersDimensions) {
  for (const auto& k : kKnown) {
    SCOPED_TRACE(k.designation);
    const auto insert = decode_iso1832(k.designation);
    EXPECT_EQ(insert.shape, k.designation.front());
    EXPECT_EQ(insert.included_angle_deg, k.angle_deg);
    EXPECT_EQ(insert.clearance_deg, k.clearance_deg);
    EXPECT_EQ(insert.tolerance_class, k.tolerance_class);
    EXPECT_EQ(insert.type, k.type);
    EXPECT_NEAR(insert.edge_length_mm, k.edge_mm, 0.05);
    EXPECT_DOUBLE_EQ(insert.thickness_mm, k.thickness_mm);
    EXPECT_DOUBLE_EQ(insert.re_mm, k.re_mm);
  }
}

TEST(Iso1832, EveryClearanceLetterHasItsAngle) {
  const std::string letters = "ABCDEFGNP";
  const double deg[] = {3, 5, 7, 15, 20, 25, 30, 0, 11};
  for (std::size_t i = 0; i < letters.size(); ++i)
    EXPECT_EQ(decode_iso1832(std::string("T") + letters[i] + "MT 160408").clearance_deg,
              deg[i])
        << letters[i];
}

TEST(Iso1832, EveryThicknessCodeIsASixteenthOfAnInchStep) {
  // Independent of the table: each is a multiple of 1/64 inch, cut to 0.01 mm.
  for (const std::string code :
       {"01", "T1", "02", "T2", "03", "T3", "04", "05", "06", "07", "09", "11", "12"}) {
    const double t = decode_iso1832("SNMG 12" + code + "08").thickness_mm;
    const double sixty_fourths = t / 25.4 * 64;
    EXPECT_NEAR(sixty_fourths, std::round(sixty_fourths), 0.03) << code;
    if (code.front() != 'T') {
      EXPECT_EQ(static_cast<int>(t), std::stoi(code)) << code;
    }
  }
}

TEST(Iso1832, EdgeLengthsOfEveryShapeFollowFromTheirCircle) {
  // A polygon of side l around a circle of diameter d has area (sides l) d/4; of the
  // rhombus the area is also l^2 sin(angle), of the regular one (n/4) l^2/tan(pi/n).
  const double d = 12.7, pi = std::acos(-1.0);
  for (const std::string rhombus :
       {"CNMG 1204", "DNMG 1504", "ENMG 1304", "MNMG 1204", "VNMG 2204"}) {
    const auto insert = decode_iso1832(rhombus + "08");
    const double l = insert.edge_length_mm;
    EXPECT_NEAR(l * l * std::sin(insert.included_angle_deg * pi / 180), 4 * l * d / 4,
                1e-9)
        << rhombus;
  }
  const std::pair<std::string, int> regular[] = {{"TNMG 2204", 3},
                                                 {"SNMG 1204", 4},
                                                 {"PNMG 0904", 5},
                                                 {"HNMG 0704", 6},
                                                 {"ONMG 0504", 8}};
  for (const auto& [name, n] : regular) {
    const auto insert = decode_iso1832(name + "08");
    const double l = insert.edge_length_mm;
    EXPECT_NEAR(n / 4.0 * l * l / std::tan(pi / n), n * l * d / 4, 1e-9) << name;
    EXPECT_NEAR(insert.included_angle_deg, 180.0 - 360.0 / n, 1e-12) << name;
  }
}

TEST(Iso1832, SpacingAndTrailingTextChangeNothing) {
  for (const std::string s : {"CNMG120408", "CNMG 12 04 08", "CNMG 120408-PM",
                              "CNMG 120408E-M5", "CNMG 120408 EN"}) {
    SCOPED_TRACE(s);
    const auto insert = decode_iso1832(s);
    EXPECT_EQ(insert.re_mm, 0.8);
    EXPECT_EQ(insert.thickness_mm, 4.76);
  }
  EXPECT_EQ(decode_iso1832("TCGT 16T300").re_mm, 0.0);  // 00 is a sharp corner
}

TEST(Iso1832, NamesTheSymbolItCannotRead) {
  const std::pair<std::string, std::string> bad[] = {
      {"", "symbol 1"},
      {"QNMG 120408", "symbol 1"},
      {"COMG 120408", "symbol 2"},
      {"CNZG 120408", "symbol 3"},
      {"CNMZ 120408", "symbol 4"},
      {"CNMG 1X0408", "symbol 5"},
      {"CNMG 130408", "symbol 5"},
      {"CNMG 040408", "symbol 5"},  // 3.97 and 4.76 mm circles both print 04
      {"CNMG 128808", "symbol 6"},
      {"CNMG 1204", "symbol 7"},
      {"CNMG 12040", "symbol 7"},
      {"CNMG 1204X8", "symbol 7"},
      {"CNMG 1204080", "symbol 7"},
      {"RCMT 120408", "symbol 7"},
      {"RCMT 0004M0", "symbol 5"},
      {"cnmg 120408", "symbol 1"},
  };
  for (const auto& [designation, where] : bad) {
    SCOPED_TRACE(designation);
    try {
      decode_iso1832(designation);
      ADD_FAILURE() << "was read";
    } catch (const std::domain_error& e) {
      EXPECT_NE(std::string(e.what()).find(where), std::string::npos) << e.what();
    }
  }
}

}  // namespace
}  // namespace turnwright::catalogue
