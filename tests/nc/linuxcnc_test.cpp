// The programs' texts through LinuxCNC's interpreter: its canonical moves make the
// contour, with the plan's conditions.
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <sstream>

#include "../rs274.hpp"
#include "canonical.hpp"
#include "check.hpp"

namespace turnwright::nc {
namespace {

namespace fs = std::filesystem;
using namespace test;

bool there(const turnwright::test::Rs274& rs274) {
  return !rs274.canonical("G21\nG0 X1\nM2\n", "T1 P1\n").empty();
}

using Change = std::function<std::string(std::string)>;

const Change kAsWritten = [](std::string t) { return t; };

// Of the programs for `asked`, changed, as programs for `p`.
Faults faults_of(const turnwright::test::Rs274& rs274, const Planned& p,
                 const Planned& asked, const Change& change = kAsWritten) {
  const auto all = programs(asked.part, asked.plan);
  Check check(p);
  Faults refused;
  for (const auto& program : all.setups) {
    const auto canonical = rs274.canonical(
        change(text(program, {.control = Control::linuxcnc})), tool_table(all.setups));
    if (canonical.empty()) refused.push_back("rs274 refuses the program");
    check.setup(program.setup, ways_of(canonical));
  }
  check.contour();
  refused.insert(refused.end(), check.faults().begin(), check.faults().end());
  return refused;
}

class NcThroughLinuxCnc : public testing::Test {
 protected:
  void SetUp() override {
    if (there(rs274)) return;
    std::fputs("NOT CHECKED: no rs274 of LinuxCNC, see scripts/rs274\n", stderr);
    GTEST_SKIP() << "rs274 is not there";
  }
  turnwright::test::Rs274 rs274;
};

TEST_F(NcThroughLinuxCnc, OfReferencePartsAreTakenAndMakeTheContour) {
  for (const auto& name : reference_parts()) {
    const auto p = planned_reference(name);
    if (p.plan.status != planning::PlanStatus::ok) continue;
    EXPECT_EQ(listed(faults_of(rs274, p, p)), "") << name;
  }
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

TEST_F(NcThroughLinuxCnc, PlantedErrorsAreFound) {
  const auto p = planned_reference("threaded-spindle");
  ASSERT_EQ(listed(faults_of(rs274, p, p)), "");
  const std::vector<std::pair<const char*, Change>> slips = {
      {"a radius 5 um too small",
       [](auto t) { return replaced(t, "X28 F0.3", "X27.99 F0.3"); }},
      {"no limit of the spindle",
       [](auto t) {
         return t.replace(t.find(" D"), t.find(" S", t.find("G96")) - t.find(" D"), "");
       }},
      {"another feed", [](auto t) { return replaced(t, " F0.", " F1."); }},
      {"another speed", [](auto t) { return replaced(t, " S2", " S3"); }},
      {"another pitch", [](auto t) { return replaced(t, " K1.5", " K1.6"); }},
      {"a rapid through the part",
       [](auto t) { return replaced(t, "\nG1 Z-", "\nG0 Z-"); }},
      {"an arc the other way",
       [](auto t) { return replaced(replaced(t, "\nG2 ", "\nG0 "), "\nG3 ", "\nG2 "); }}};
  for (const auto& [what, slip] : slips)
    EXPECT_FALSE(faults_of(rs274, p, p, slip).empty()) << what;
  auto other = p;
  for (auto& t : other.part.fixed_tools) t.re_mm *= 2;
  EXPECT_FALSE(faults_of(rs274, p, other).empty()) << "another corner, on an arc";
  auto pin = planned_reference("titanium-pin"), corner = pin;
  ASSERT_EQ(listed(faults_of(rs274, pin, pin)), "");
  for (auto& t : corner.part.tools) t.re_mm *= 1.1;
  EXPECT_FALSE(faults_of(rs274, pin, corner).empty()) << "another corner, on a cone";
  auto hole = planned_reference("drilled-bush"), small = hole;
  ASSERT_EQ(listed(faults_of(rs274, hole, hole)), "");
  for (auto& e : small.part.drawing.inner) e.left_mm = e.right_mm -= 1e-3;
  EXPECT_FALSE(faults_of(rs274, hole, small).empty())
      << "bores too tight by 0.5 um on the radius";
}

}  // namespace
}  // namespace turnwright::nc
