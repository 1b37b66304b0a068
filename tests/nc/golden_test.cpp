// Programs of the reference parts in every dialect, of which those of threaded-spindle,
// drilled-bush and pump-shaft were read by eye and all are read back in dialect_test.  They
// change with the plans: TURNWRIGHT_WRITE_PROGRAMS=1 writes them anew, to be read again.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "plans.hpp"

namespace turnwright::nc {
namespace {

namespace fs = std::filesystem;
using namespace test;

std::string contents(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(NcGolden, ProgramsAreThoseThatAreKept) {
  const bool anew = std::getenv("TURNWRIGHT_WRITE_PROGRAMS") != nullptr;
  for (const auto& name : reference_parts()) {
    const auto p = planned_reference(name);
    const auto made = programs(p.part, p.plan);
    for (const auto& d : gcode::dialects()) {
      const Settings settings{.control = d.control, .program_number = 1001};
      auto all = made.setups;
      fit_to_control(all, settings, p.part.machine);
      number_tools(all, settings);
      for (const auto& program : all) {
        const auto file =
            source("tests/data/nc") / d.id /
            (name + '-' + std::to_string(program.setup + 1) + std::string(d.extension));
        if (anew) {
          fs::create_directories(file.parent_path());
          std::ofstream(file) << text(program, settings);
        }
        EXPECT_EQ(text(program, settings), contents(file)) << file;
      }
    }
  }
}

}  // namespace
}  // namespace turnwright::nc
