#include "planning/values/side_by_side.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include <numeric>
#include <stdexcept>
#include <vector>

#include "../parts.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/document/process_plan.hpp"
#include "turnwright/planning/plan.hpp"

namespace turnwright::planning {
namespace {

TEST(SideBySide, DoesEachPieceOnce) {
  std::vector<int> done(1000);
  side_by_side(done.size(), [&](std::size_t i) { ++done[i]; });
  EXPECT_EQ(done, std::vector<int>(1000, 1));
  side_by_side(0, [](std::size_t) { FAIL(); });
}

TEST(SideBySide, AFailureAndAStopReachTheCaller) {
  EXPECT_THROW(side_by_side(10,
                            [](std::size_t i) {
                              if (i == 7) throw std::domain_error("seven");
                            }),
               std::domain_error);
  std::stop_source stop;
  stop.request_stop();
  const auto token = stop.get_token();
  const Listening listening(token);
  EXPECT_THROW(side_by_side(10, [](std::size_t) { leave_if_asked(); }), Cancelled);
}

// Setups, remedies, changed requests and rules are planned side by side.
TEST(SideBySide, PlansHaveTheSameBytesOnOneThreadAndOnMany) {
  auto asking = reference_part("gearbox-input-shaft");
  asking["what_if"] = {{{"limit", "power of lathe-medium"}, {"change_percent", 10}},
                       {{"name", "cheaper"}, {"set", {{"/rates/machine_per_min", 0.5}}}}};
  auto without_remedy = reference_part("infeasible-as-drawn");
  for (const auto& document : {asking, without_remedy}) {
    const auto read = document::prepared_part(document, shop(), "part");
    const auto bytes = [&] {
      return document::to_json(plan(read.part, read.what_if), read.assumed).dump();
    };
    tbb::task_arena one(1), four(4);
    EXPECT_EQ(one.execute(bytes), four.execute(bytes));
  }
}

}  // namespace
}  // namespace turnwright::planning
