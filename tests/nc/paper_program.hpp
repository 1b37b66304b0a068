#pragma once
#include <string>
#include <vector>

#include "plans.hpp"
#include "turnwright/nc/program.hpp"

/// Programs written by hand, with the operations of a plan that was not planned.
namespace turnwright::nc::test {

class Paper {
 public:
  explicit Paper(const nlohmann::json& document)
      : part_(document::prepared_part(document, catalogue(), "paper").part) {
    begin_setup();
  }

  Paper& setup() {
    begin_setup();
    return *this;
  }
  Paper& clamping(planning::Clamping clamping) {
    plan_.setups.back().clamping = clamping;
    return *this;
  }
  Paper& stop(const std::string& told) {
    Step step;
    step.comments = {told};
    step.stop = true;
    steps().push_back(step);
    return *this;
  }
  /// The tool comes from where tools are changed; blades and drills have a size.
  Paper& operation(planning::OperationKind kind, const std::vector<std::string>& on,
                   const std::string& tool, double size_mm = 0) {
    planning::OperationPlan o;
    o.id = "o" + std::to_string(plan_.setups.back().operations.size());
    o.kind = kind;
    o.on = on;
    o.tool = tool;
    o.passes.resize(1);
    o.passes[0].ap_mm = size_mm;
    plan_.setups.back().operations.push_back(o);
    steps().emplace_back();
    return rapid(100, 100);
  }
  Paper& rapid(double x, double z) { return move({Move::Kind::rapid, x, z}); }
  Paper& feed(double x, double z) { return move({Move::Kind::feed, x, z}); }
  Paper& thread(double x, double z) { return move({Move::Kind::thread, x, z}); }
  Paper& arc(double x, double z, double centre_x, double centre_z, bool clockwise) {
    return move({Move::Kind::arc, x, z, {centre_x, centre_z}, clockwise});
  }

  Planned planned() const { return {part_, plan_}; }
  Programs programs() const { return programs_; }

 private:
  std::vector<Step>& steps() { return programs_.setups.back().steps; }
  Paper& move(const Move& m) {
    steps().back().moves.push_back(m);
    return *this;
  }
  void begin_setup() {
    const auto s = plan_.setups.size();
    plan_.setups.emplace_back();
    plan_.setups.back().hold = part_.setups.at(s).hold;
    programs_.setups.emplace_back();
    programs_.setups.back().setup = s;
  }

  planning::PreparedPart part_;
  planning::ProcessPlan plan_;
  Programs programs_;
};

}  // namespace turnwright::nc::test
