#pragma once
#include <array>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "turnwright/gcode/dialect.hpp"

/// The variables of a program: #1, #<name>.
namespace turnwright::review {

/// Why a line cannot be followed, as a sentence.
class NotFollowed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a variable holds; none: vacant, which Fanuc tells from 0.
using Value = std::optional<double>;

/// The variables that a program has, of LinuxCNC, or of Fanuc and those who follow it:
///
///     LinuxCNC   #1 to #30, #<name>        of each subroutine
///                #31 to #5000, #<_name>    of all
///                #5420, #5422, #<_x>, #<_z>   the tip's radius and place
///     Fanuc      #0                        vacant
///                #1 to #33                 of each macro
///                #100 to #999              of all
///
/// Those of a subroutine are 0 (LinuxCNC) or vacant (Fanuc) at first.  What the control
/// keeps beyond a program (LinuxCNC's from #5001, Fanuc's common ones, system variables) is
/// known only after the program has set it.
/// Source: [LinuxCNC] and [gEdit] in docs/bibliography.md.
class Parameters {
 public:
  explicit Parameters(gcode::Control control)
      : linuxcnc_(control == gcode::Control::linuxcnc) {}

  bool linuxcnc() const { return linuxcnc_; }

  /// @throws NotFollowed if the program does not tell the value.
  Value at(double number) const;
  double at(const std::string& name) const;
  bool exists(const std::string& name) const { return find(name).has_value(); }

  /// @throws NotFollowed for variables that a control has for itself, and too many names.
  void set(double number, Value value);
  void set(const std::string& name, double value);

  /// A subroutine begins with the first ones of its own, or ends.
  void enter(const std::map<int, double>& arguments);
  void leave();

  /// The tip's radius and place in the program's unit.
  std::optional<double> x, z;

 private:
  static constexpr int kLocals = 33;
  struct Locals {
    std::array<Value, kLocals + 1> numbered = {};
    std::map<std::string, double> named = {};
  };
  int number_of(double number) const;
  std::optional<double> find(const std::string& name) const;
  bool local(int n) const { return n >= 1 && n <= (linuxcnc_ ? 30 : kLocals); }

  bool linuxcnc_;
  std::vector<Locals> locals_ = {Locals()};
  std::map<int, Value> numbered_;
  std::map<std::string, double> named_;
};

}  // namespace turnwright::review
