#pragma once
#include <string>

#include "air.hpp"
#include "turnwright/planning/process_plan.hpp"

/// What a setup takes beside its operations.
namespace turnwright::planning {

/// What lies between the operations of a setup.
struct Between {
  int indexings = 0;  ///< tools brought in
  int eased = 0;      ///< stops to change the force of the jaws
  double rapid_mm =
      0;  ///< to and from where tools are changed, and on to the next surface
};

/// An operation as the one before and the one after it see it.
struct InOrder {
  std::string tool;  ///< with its size, where it has several
  Stage stage = Stage::roughing;
  bool chuck_alone = false;  ///< before a centre or a rest comes in
  bool inner = false;
  double from_mm = 0, to_mm = 0;  ///< of air.hpp
  bool milled = false;            ///< by hand or another program: nothing moves
};

/// Follows the operations of a setup.  The tool goes to where tools are changed before
/// another tool, a stop and what is milled, and at the end.
class Order {
 public:
  Order(const PreparedPart& plan, std::size_t setup, Clamping clamping, double front_mm);
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
  bool clamped_ = false, out_ = false;  // out_: of its home
  InOrder last_;
};

/// Minutes of a setup beside its operations: what lies between them, the clamping, loading
/// and preparing.  Costs are left at nothing.
Breakdown besides_cutting(const PreparedPart& plan, Clamping clamping,
                          const Between& between);

}  // namespace turnwright::planning
