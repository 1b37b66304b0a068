#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "cutters.hpp"
#include "drawn_part.hpp"
#include "review/cut/section.hpp"
#include "ways.hpp"

/// Cuts the stock of a plan with the ways of its programs, setup after setup: whole
/// inserts with their holders, in the half section.
namespace turnwright::nc::test {

enum class Fault {
  gouge,   ///< cut beyond the drawn contour
  left,    ///< stock that fillets do not allow
  lean,    ///< a wall off its plane, above its fillet
  rapid,   ///< a rapid in material
  holder,  ///< a holder in material
  jaws,    ///< a tool in the jaws
  centre,  ///< a tool in the tailstock's centre or its body
  start,   ///< a pass that starts on a finished surface
  again,   ///< a finishing tool that enters the contour again, so many times
  thread   ///< a thread or knurl not made to its depth, a knurl along its element
};
const char* name(Fault fault);
struct Finding {
  Fault fault = Fault::gouge;
  std::string where;  ///< an operation, a surface or a wall
  double mm = 0;      ///< largest
  Spot at;            ///< of the part
};

/// What of a finding is tolerated [mm].
struct Tolerances {
  double gouge = 1e-4, left = 1e-4, lean = 1e-3;
  double touch = 2e-4;  ///< by which tools are smaller for collisions
};

class CutSimulation {
 public:
  explicit CutSimulation(const Planned& p, double pitch_mm = 0.01,
                         const Tolerances& tolerances = {});

  void setup(std::size_t s, const std::vector<Way>& ways);
  /// Compares with the drawing when all setups are done.
  void compare();
  /// The worst of each fault and place.
  std::vector<Finding> findings() const;
  const DrawnPart& drawn() const { return drawn_; }

 private:
  struct Body {  // a cutter in the part's coordinates, and smaller for collisions
    Cutter cutter;
    Polygon edge, small_edge;
    std::vector<Polygon> small_holder;
  };
  struct Obstacle {
    Fault fault = Fault::jaws;
    Polygon body;
    bool inside = true;  // inner tools too
  };

  const planning::OperationPlan* operation(const std::string& id) const;
  const Body& body(const planning::OperationPlan& o);
  Spot place(double x, double z) const;
  void add_obstacles();
  void add_centre();
  void follow(const Way& w);
  void tap(const Way& w, const planning::OperationPlan& o);
  void press(const Way& w, const planning::OperationPlan& o);
  void collide(const Way& w, const Body& b, const Spot& from, const Spot& to);
  void first_touch(const Body& b, const Way& w, const Polygon& sweep, const Spot& from,
                   const Spot& to);
  void entered(const Body& b, const Way& w, const Spot& at);
  bool made(const Lines& lines, std::size_t i, double surface) const;
  void compare(const Lines& material, const Lines& least, const Lines& full);
  void compare_walls();
  void compare_threads();
  void find(Fault fault, const std::string& where, double mm, const Spot& at);

  const Planned& p_;
  Tolerances tolerances_;
  DrawnPart drawn_;
  Section material_, least_, full_;
  std::size_t setup_ = 0;
  double sign_ = 1, free_z_ = 0;
  std::map<std::string, Body> bodies_;  // of the setup
  std::vector<Obstacle> obstacles_;
  bool centred_ = false;
  bool in_pass_ = false, touched_ = false;
  std::map<std::pair<std::string, bool>, int> entered_;  // by tool, and in bores
  std::map<std::string, double> threads_;
  std::map<std::string, std::pair<double, double>> pressed_;  ///< from and to, of knurls
  std::map<std::pair<Fault, std::string>, Finding> findings_;
};

/// A line for each finding.
std::string listed(const std::vector<Finding>& findings);

/// The findings of programs, from their own moves.
std::vector<Finding> simulated(const Planned& p, const Programs& all);

/// Whether a finding is told: a contour entered again for a reason that the program says.
bool is_told(const Finding& finding, const Programs& all);

}  // namespace turnwright::nc::test
