#include "engagement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "mounted_edge.hpp"
#include "turnwright/base/cancelled.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/base/units.hpp"

namespace turnwright::review {
namespace {

using catalogue::FixedUse;
using planning::OperationKind;
using toolpath::Move;

constexpr double kTaken_mm = 1e-3;       // less is not told
constexpr double kInStock_mm = 2e-3;     // of a rapid
constexpr double kBesideFace_mm = 0.75;  // a cut across so near to a face belongs to it
constexpr double kBesideShare = 0.1;     // of a pass's section, on other surfaces
constexpr double kArcChord_mm = 1e-3;
constexpr int kMostChords = 500;
constexpr std::size_t kMostPieces =
    60'000;  // straight ways of a program that are followed
constexpr std::size_t kMostSamples =
    1'000'000;  // of a pass; more are told as another one

// What a move takes off on one line.
struct Sample {
  double ap_mm = 0, way_mm = 0, x_mm = 0;
  std::size_t line = 0;  // of the program
};

// The samples of a pass on one surface.
using Samples = std::vector<Sample>;

double rpm_at(const toolpath::Step& s, double x_mm) {
  if (!s.constant_surface_speed) return s.S;
  return std::min(s.n_max_rpm, 1000 * s.S / (2 * units::kPi * std::max(x_mm, 1e-6)));
}

// The median of a member by the way.
double prevailing(Samples all, double Sample::*member) {
  std::ranges::sort(all, {}, member);
  double whole = 0, sum = 0;
  for (const auto& s : all) whole += s.way_mm;
  for (const auto& s : all)
    if ((sum += s.way_mm) >= whole / 2) return s.*member;
  return 0;
}

// Area that samples take off in the half section.
double section_mm2(const Samples& all) {
  double sum = 0;
  for (const auto& s : all) sum += s.ap_mm * s.way_mm;
  return sum;
}

PassCut pass_of(const Samples& all, const toolpath::Step& at) {
  PassCut p;
  p.line = all.front().line;
  p.ap_mm = prevailing(all, &Sample::ap_mm);
  p.x_mm = prevailing(all, &Sample::x_mm);
  p.x_from_mm = p.x_to_mm = all.front().x_mm;
  for (const auto& s : all) {
    if (s.ap_mm > p.most_mm) {
      p.most_mm = s.ap_mm;
      p.most_line = s.line;
    }
    p.x_from_mm = std::min(p.x_from_mm, s.x_mm);
    p.x_to_mm = std::max(p.x_to_mm, s.x_mm);
    p.length_mm += s.way_mm;
    p.time_min += s.way_mm / (at.f_mm_rev * rpm_at(at, s.x_mm));
  }
  return p;
}

void take_in(PassCut& main, const PassCut& beside) {
  main.line = std::min(main.line, beside.line);
  main.length_mm += beside.length_mm;
  main.time_min += beside.time_min;
  if (beside.most_mm <= main.most_mm) return;
  main.most_mm = beside.most_mm;
  main.most_line = beside.most_line;
}

bool alike(const toolpath::Step& a, const toolpath::Step& b) {
  return a.S == b.S && a.constant_surface_speed == b.constant_surface_speed &&
         a.f_mm_rev == b.f_mm_rev;
}

class Follower {
 public:
  Follower(const planning::PreparedPart& part, const ReviewedProgram& program,
           const std::vector<MountedTool>& tools, Workpiece& workpiece)
      : part_(part), program_(program), tools_(tools), w_(workpiece) {
    const bool left = part.setups[program.setup].hold == part::End::left;
    sign_ = left ? 1 : -1;
    zero_z_ = (left ? part::length_mm(part.drawing) : 0) + sign_ * program.zero_mm;
    out_.setup = program.setup;
    out_.unknown = program.program.unknown;
    out_.assumed = program.program.assumed;
  }

  ReviewedSetup result() {
    for (const auto& run : program_.program.runs) follow(run);
    return std::move(out_);
  }

 private:
  void follow(const Run& run) {
    out_.minutes.air += run.wait_min;
    if (run.step.stop) {
      end_pass();
      ++out_.stops;
      return;
    }
    if (run.step.tool != tool_number_) change_tool(run);
    at_ = &run.step;
    if (run.step.milling) return mill(run);
    for (const auto& m : run.moves) {
      leave_if_asked();
      take_time(m);
      const bool rapid = m.to.kind == Move::Kind::rapid;
      if (rapid) end_pass();
      if (tool_ && m.from && !knurls() && !(rapid && edge_.threads)) move(m);
    }
    end_pass();
  }

  // Takes time and leaves the stock as it is.
  void mill(const Run& run) {
    for (const auto& m : run.moves) take_time(m);
  }

  void change_tool(const Run& run) {
    tool_number_ = run.step.tool;
    if (tool_number_ > 0) out_.minutes.tool_changes += part_.machine.index_min;
    const auto found = std::ranges::find(tools_, tool_number_, &MountedTool::number);
    tool_ = found == tools_.end() ? nullptr : &*found;
    if (tool_) {
      edge_ = mounted_edge(*tool_, sign_);
      if (knurls() && missing_.insert(tool_number_).second)
        out_.unknown.push_back(
            {run.moves.empty() ? 0 : run.moves.front().line,
             fmt::format("T{}", tool_number_),
             tr("A knurling wheel takes nothing off, and its forces are "
                "not known: its ways are not followed.")});
    } else if (!run.step.milling && missing_.insert(tool_number_).second) {
      out_.unknown.push_back(
          {run.moves.empty() ? 0 : run.moves.front().line,
           tool_number_ > 0 ? fmt::format("T{}", tool_number_) : tr("no tool is called"),
           tr("No document of this tool is given: its cuts are not "
              "followed, and leave the stock as it is.")});
    }
  }

  void take_time(const ReadMove& m) {
    if (!m.from) return;
    Move from{Move::Kind::rapid, m.from->h_mm, m.from->z_mm};
    from.y_mm = m.from_y_mm;
    out_.minutes.air += toolpath::move_min(*at_, from, m.to, part_.machine);
  }

  Spot place(double x, double z) const { return {x, zero_z_ + sign_ * z}; }

  void move(const ReadMove& m) {
    const Spot from = place(m.from->h_mm, m.from->z_mm);
    const Spot to = place(m.to.x_mm, m.to.z_mm);
    if (m.to.kind == Move::Kind::rapid) return rapid(from, to, m.line);
    if (m.to.kind == Move::Kind::thread)
      return edge_.on_axis ? tap(from, to, m.line) : thread(from, to, m.line);
    if (m.to.kind == Move::Kind::feed) return straight(from, to, m.line);
    const auto way = chords(m);
    for (std::size_t i = 1; i < way.size(); ++i) straight(way[i - 1], way[i], m.line);
  }

  std::vector<Spot> chords(const ReadMove& m) const {
    const auto& c = m.to.centre;
    const double h = m.from->h_mm - c.h_mm, z = m.from->z_mm - c.z_mm;
    const double R = std::hypot(h, z), a = std::atan2(h, z);
    double b = std::atan2(m.to.x_mm - c.h_mm, m.to.z_mm - c.z_mm);
    // With X up and Z to the right the angle from Z to X rises against the clock.
    if (m.to.clockwise && b >= a) b -= 2 * units::kPi;
    if (!m.to.clockwise && b <= a) b += 2 * units::kPi;
    const double step = 2 * std::acos(std::max(0.0, 1 - kArcChord_mm / R));
    const int n =
        std::clamp(static_cast<int>(std::abs(b - a) / step) + 1, 1, kMostChords);
    std::vector<Spot> way;
    for (int i = 0; i <= n; ++i) {
      const double t = a + (b - a) * i / n;
      way.push_back(i < n ? place(c.h_mm + R * std::sin(t), c.z_mm + R * std::cos(t))
                          : place(m.to.x_mm, m.to.z_mm));
    }
    return way;
  }

  void rapid(const Spot& from, const Spot& to, std::size_t line) {
    if (edge_.small.empty()) return;
    const double mm = w_.section.depth(swept(edge_.small, from, to));
    if (!(mm > kInStock_mm)) return;
    if (out_.rapids.empty() || out_.rapids.back().line != line)
      out_.rapids.push_back({line, 0});
    out_.rapids.back().mm = std::max(out_.rapids.back().mm, mm);
  }

  void straight(const Spot& from, const Spot& to, std::size_t line) {
    leave_if_asked();  // an arc has hundreds of these ways
    const double dx = std::abs(to.x - from.x), dz = std::abs(to.z - from.z);
    const double way = std::hypot(dx, dz);
    if (!(way > 0) || !goes_on(line)) return;
    if (samples_ > kMostSamples) end_pass();
    const bool across = dx > dz;
    const double part = std::max(dx, dz) / way;
    const auto& lines = across ? w_.section.rows : w_.section.columns;
    std::vector<std::pair<std::string, Sample>> samples;
    const auto taken = [&](std::size_t i, double length) {
      if (!(length * part > kTaken_mm)) return;
      const double at = lines.at(i);
      const double a = across ? from.x : from.z, b = across ? to.x : to.z;
      const double u = std::clamp((at - a) / (b - a), 0.0, 1.0);
      const double x = std::lerp(from.x, to.x, u), z = std::lerp(from.z, to.z, u);
      const double radius =
          edge_.on_axis ? edge_.radius_behind_mm(std::abs(at - b)) : std::abs(x);
      samples.push_back({surface(across, across ? z : at),
                         {length * part, w_.pitch_mm / part, radius, line}});
    };
    w_.section.cut(swept(edge_.edge, from, to), across ? Family::rows : Family::columns,
                   taken);
    // A short move takes off more lines than it passes: those along the edge.
    samples_ += samples.size();
    const double all = static_cast<double>(samples.size()) * w_.pitch_mm / part;
    // In the order of the way.
    if (across ? from.x > to.x : from.z > to.z) std::ranges::reverse(samples);
    for (auto& [on, sample] : samples) {
      sample.way_mm *= std::min(1.0, way / all);
      auto& on_surface = pass_[on];
      if (on_surface.empty()) surfaces_.push_back(on);
      on_surface.push_back(sample);
    }
  }

  // A knurling wheel takes nothing off.
  bool knurls() const { return tool_->fixed && tool_->fixed->use == FixedUse::knurling; }

  // Whether one more way is followed; tells the first that is not.
  bool goes_on(std::size_t line) {
    if (++pieces_ == kMostPieces)
      out_.unknown.push_back({line, tr("the cuts from here on"),
                              tr("The program has more ways than are followed.")});
    return pieces_ < kMostPieces;
  }

  std::string surface(bool across, double z) const {
    if (edge_.plunges) {
      const double middle = z + sign_ * edge_.width_mm / 2;
      const bool parts = tool_->fixed->use == FixedUse::parting;
      return parts ? w_.face_at(middle, 2 * edge_.width_mm, edge_.inner)
                   : w_.element_at(middle, edge_.inner);
    }
    if (edge_.on_axis && tool_->fixed->use != FixedUse::reaming &&
        tool_->fixed->use != FixedUse::counterboring &&
        tool_->fixed->use != FixedUse::countersinking) {
      const bool centres = tool_->fixed->use == FixedUse::centring;
      const double end = sign_ > 0 ? part::length_mm(part_.drawing) : 0;
      const auto bore = centres ? std::string() : w_.element_at(end, true);
      if (!bore.empty()) return bore;
      return sign_ > 0 ? "right" : "left";
    }
    if (!across) return w_.element_at(z, edge_.inner);
    return w_.face_at(z, std::max(kBesideFace_mm, edge_.re_mm), edge_.inner);
  }

  // The infeed of a cut of a thread, from the blank's surface and the cut before.
  void thread(const Spot& from, const Spot& to, std::size_t line) {
    const auto [low, high] = std::minmax(from.z, to.z);
    std::map<std::string, std::vector<double>> depths;
    for (std::size_t i = 0; i < w_.section.columns.size(); ++i) {
      const double z = w_.section.columns.at(i);
      if (z < low || z > high) continue;
      const auto surface = w_.surface_mm(i, edge_.inner);
      if (!surface) continue;
      const double depth = edge_.inner ? to.x - *surface : *surface - to.x;
      if (depth > kTaken_mm) depths[w_.element_at(z, edge_.inner)].push_back(depth);
    }
    for (auto& [on, all] : depths) {
      auto middle = all.begin() + std::ssize(all) / 2;
      std::nth_element(all.begin(), middle, all.end());
      const double before = std::exchange(threads_[on], *middle);
      if (!(*middle - before > kTaken_mm)) continue;
      PassCut p;
      p.line = p.most_line = line;
      p.ap_mm = p.most_mm = *middle - before;
      p.before_mm = before;
      p.x_mm = p.x_from_mm = p.x_to_mm = std::abs(to.x);
      p.length_mm = static_cast<double>(all.size()) * w_.pitch_mm;
      p.time_min = p.length_mm / (at_->f_mm_rev * rpm_at(*at_, p.x_to_mm));
      add(on, p);
    }
  }

  // A tap cuts the threads of the drawing that its full diameter passes; on its way back it
  // finds them cut.
  void tap(const Spot& from, const Spot& to, std::size_t line) {
    const double lead = sign_ * tool_->fixed->lead * at_->f_mm_rev;
    const auto [low, high] = std::minmax({from.z + lead, to.z + lead});
    const auto& d = part_.drawing;
    for (std::size_t i = 0; i < d.inner.size(); ++i) {
      const auto& e = d.inner[i];
      if (!part::is_tapped(e)) continue;
      const double z0 = part::inner_left_z_mm(d, i);
      const double length = std::min(high, z0 + e.length_mm) - std::max(low, z0);
      if (!(length > kTaken_mm) || threads_[e.id] > 0) continue;
      threads_[e.id] = e.cut->depth_mm;
      PassCut p;
      p.line = p.most_line = line;
      p.ap_mm = p.most_mm = e.cut->depth_mm;
      p.x_mm = p.x_from_mm = p.x_to_mm = e.cut->drawn.left_mm / 2;
      p.length_mm = 2 * length;
      p.time_min = p.length_mm / (at_->f_mm_rev * at_->S);
      add(e.id, p);
    }
  }

  // What a pass takes off beside its surfaces, at their ends and up a wall, belongs to the
  // one that it has just cut, or else to the next.
  void end_pass() {
    const auto largest = std::ranges::max_element(
        pass_, {}, [](const auto& entry) { return section_mm2(entry.second); });
    if (largest == pass_.end()) return;
    const double least = kBesideShare * section_mm2(largest->second);
    std::vector<std::pair<std::string, PassCut>> all;
    std::vector<PassCut> before;
    for (const auto& on : surfaces_) {
      const auto& samples = pass_.at(on);
      auto cut = pass_of(samples, *at_);
      if (section_mm2(samples) >= least) {
        cut.beside = on != largest->first;
        for (const auto& b : std::exchange(before, {})) take_in(cut, b);
        all.emplace_back(on, cut);
      } else if (all.empty()) {
        before.push_back(cut);
      } else {
        take_in(all.back().second, cut);
      }
    }
    for (const auto& [on, cut] : all)
      if (cut.beside) add(on, cut);
    for (const auto& [on, cut] : all)
      if (!cut.beside) add(on, cut);
    pass_.clear();
    surfaces_.clear();
    samples_ = 0;
    w_.section.drop_loose(part::length_mm(part_.drawing) / 2);
  }

  OperationKind kind(const std::string& on) const {
    if (!tool_->turning) return OperationKind::fixed;
    const bool face = on == "left" || on == "right" || on.find('|') != on.npos;
    if (face) return OperationKind::face;
    return edge_.inner ? OperationKind::bore_rough : OperationKind::rough;
  }

  void add(const std::string& on, const PassCut& pass) {
    out_.minutes.cutting += pass.time_min;
    out_.minutes.air -= pass.time_min;
    const auto last = std::find_if(out_.cuts.rbegin(), out_.cuts.rend(),
                                   [&](const Cut& c) { return c.on == on; });
    if (last != out_.cuts.rend() && last->tool == tool_number_ && alike(last->at, *at_)) {
      last->passes.push_back(pass);
      return;
    }
    Cut cut;
    cut.on = on;
    cut.tool = tool_number_;
    cut.tool_id = id(*tool_);
    cut.size_mm = tool_->size_mm;
    cut.kind = kind(on);
    cut.at = *at_;
    cut.passes = {pass};
    out_.cuts.push_back(std::move(cut));
  }

  const planning::PreparedPart& part_;
  const ReviewedProgram& program_;
  const std::vector<MountedTool>& tools_;
  Workpiece& w_;
  double sign_ = 1, zero_z_ = 0;
  ReviewedSetup out_;
  int tool_number_ = -1;  // none was called
  const MountedTool* tool_ = nullptr;
  MountedEdge edge_;
  const toolpath::Step* at_ = nullptr;
  std::map<std::string, Samples> pass_;
  std::vector<std::string> surfaces_;     // of the pass, as it met them
  std::size_t pieces_ = 0, samples_ = 0;  // of the program, of the pass
  std::map<std::string, double> threads_;
  std::set<int> missing_;
};

}  // namespace

ReviewedSetup follow(const planning::PreparedPart& part, const ReviewedProgram& program,
                     const std::vector<MountedTool>& tools, Workpiece& workpiece) {
  return Follower(part, program, tools, workpiece).result();
}

}  // namespace turnwright::review
