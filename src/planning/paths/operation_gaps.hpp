#pragma once
#include <string>

#include "pass_lengths.hpp"
#include "planning/clamping/jaws.hpp"
#include "turnwright/planning/process_plan.hpp"

/// Time of a setup outside its operations.
namespace turnwright::planning {

/// Tool changes, stops and rapids between the operations of a setup.
struct Between {
  int indexings = 0;    ///< tools brought in
  int eased = 0;        ///< stops to change the force of the jaws
  double rapid_mm = 0;  ///< to and from the tool change position, and to the next surface
};

/// The properties of an operation that decide what lies between it and its neighbours.
struct InOrder {
  std::string tool;  ///< with its size, where it has several
  Stage stage = Stage::roughing;
  bool chuck_alone = false;  ///< before a centre or a rest comes in
  bool inner = false;
  double from_mm = 0, to_mm = 0;  ///< of pass_lengths.hpp
  bool milled = false;            ///< by a driven tool, which comes and goes by itself
  double over_mm = 0;             ///< radius at which it comes over its place
};

/// Follows the operations of a setup in their order.  The tool returns to the tool change
/// position before another tool, a stop or a milled place, and at the end.
class Order {
 public:
  /// @param before  stage for which the jaws are tightened at the beginning
  Order(const PreparedPart& plan, std::size_t setup, Clamping clamping, double front_mm,
        Stage before = Stage::roughing);
  void add(const InOrder& operation);
  Between done();

 private:
  double home_mm(bool inner) const;
  void leave();

  const PreparedPart& p_;
  std::size_t setup_;
  Clamping clamping_;
  Home home_;
  Between sum_;
  double force_N_;
  bool clamped_ = false, out_ = false;  // out_: away from the tool change position
  InOrder last_;
};

/// Minutes of a setup outside its operations: those between them, clamping, loading and
/// preparing.  Costs stay 0.
Breakdown besides_cutting(const PreparedPart& plan, Clamping clamping,
                          const Between& between);

}  // namespace turnwright::planning
