#pragma once
#include <array>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "turnwright/gcode/dialect.hpp"

/// The variables of a program: #1, #<name>, R1, names.
namespace turnwright::review {

/// Why a line cannot be followed, as a sentence.
class NotFollowed : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// What a variable holds; none: vacant, which Fanuc tells from 0.
using Value = std::optional<double>;

/// How controls write variables, expressions and branches.
enum class Language { linuxcnc, macro_b, siemens, okuma };
Language language_of(gcode::Control control);
/// Whether words may have names of several letters, and expressions need no brackets.
inline bool has_names(Language l) {
  return l == Language::siemens || l == Language::okuma;
}

/// The variables that a program has:
///
///     LinuxCNC   #1 to #30, #<name>        of each subroutine
///                #31 to #5000, #<_name>    of all
///                #5420, #5422, #<_x>, #<_z>   the tip's radius and place
///     Fanuc      #0                        vacant
///                #1 to #33                 of each macro
///                #100 to #999              of all
///     Siemens    names of DEF and PROC     of each subprogram
///                R0 to R999                of all
///     Okuma      names                     of each subprogram, from where it sets them
///                V1 to V200, VC1 ..        of all
///
/// Those of a subroutine are 0 (LinuxCNC, Siemens) or vacant (Fanuc) at first.  What the
/// control keeps beyond a program (LinuxCNC's from #5001, Fanuc's common ones, R of
/// Siemens, V of Okuma, system variables) is known only after the program has set it.
/// Source: [LinuxCNC], [gEdit], [Siemens PGA] and [Okuma user task] in docs/bibliography.md.
class Parameters {
 public:
  explicit Parameters(gcode::Control control) : language_(language_of(control)) {}

  Language language() const { return language_; }

  /// @throws NotFollowed if the program does not tell the value.
  Value at(double number) const;
  double at(const std::string& name) const;
  bool exists(const std::string& name) const { return find(name).has_value(); }

  /// @throws NotFollowed for variables that a control has for itself, and too many names.
  void set(double number, Value value);
  void set(const std::string& name, double value);

  /// Names of Siemens that DEF has declared in this subprogram; of INT and BOOL the values
  /// are whole.
  void declare(const std::string& name, bool whole);
  bool declared(const std::string& name) const;

  /// A subroutine begins with the first ones of its own, or ends.
  void enter(const std::map<int, double>& arguments);
  void leave();
  /// What it has now is what it begins with when it is repeated.
  void keep_first() { first_.back() = locals_.back(); }
  void begin_again() { locals_.back() = first_.back(); }

  /// The tip's radius and place in the program's unit.
  std::optional<double> x, z;

 private:
  static constexpr int kLocals = 33;
  struct Locals {
    std::array<Value, kLocals + 1> numbered = {};
    std::map<std::string, double> named = {};
    std::map<std::string, bool> declared = {};
  };
  bool linuxcnc() const { return language_ == Language::linuxcnc; }
  bool has_locals() const { return linuxcnc() || language_ == Language::macro_b; }
  int number_of(double number) const;
  std::optional<double> find(const std::string& name) const;
  bool local(int n) const {
    return has_locals() && n >= 1 && n <= (linuxcnc() ? 30 : kLocals);
  }
  bool of_program(int n) const;
  bool common(const std::string& name) const;

  Language language_;
  std::vector<Locals> locals_ = {Locals()}, first_ = {Locals()};
  std::map<int, Value> numbered_;
  std::map<std::string, double> named_;
};

}  // namespace turnwright::review
