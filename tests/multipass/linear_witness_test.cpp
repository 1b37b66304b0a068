#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>

#include "../temporary_folder.hpp"
#include "variants.hpp"

// A lower bound that shares nothing with the program but the literature's equations: a mixed
// integer linear program, solved by Cbc.  Its whole numbers choose n, a cell of ln dr and, if
// literal, a cell of s = ln(Ts/Tr); within a cell ln ds lies between the chord and the tangent
// of ln(dt - n exp(ln dr)) and ln(theta + (1 - theta) exp s) below its chord.  Each exponential
// of the cost lies above tangents, which are added where the last solution is until none is
// missing [Kelley 1960].
namespace turnwright::multipass {
namespace {

constexpr int kCells = 24, kRounds = 40;
constexpr double kMissing = 1e-7;  // of the cost, by tangents that were not added

using Terms = std::map<std::string, double>;  // by variable; "" is the constant

Terms operator+(Terms a, const Terms& b) {
  for (const auto& [name, c] : b) a[name] += c;
  return a;
}
Terms operator*(double s, Terms a) {
  for (auto& [name, c] : a) c *= s;
  return a;
}

// The program in the LP format of CPLEX, which Cbc reads.
class LinearProgram {
 public:
  void at_most(const Terms& terms, double limit) {
    std::ostringstream row;
    row.precision(17);
    for (const auto& [name, c] : terms)
      if (!name.empty()) row << (c < 0 ? " - " : " + ") << std::abs(c) << ' ' << name;
    const auto constant = terms.find("");
    row << " <= " << limit - (constant == terms.end() ? 0 : constant->second);
    rows_ += row.str() + '\n';
  }
  void equal(const Terms& terms, double value) {
    at_most(terms, value);
    at_most(-1 * terms, -value);
  }
  void is_free(const std::string& name) { bounds_ += name + " free\n"; }
  void is_whole(const std::string& name) { whole_ += name + '\n'; }
  void objective(const Terms& cost) { cost_ = cost; }

  // The optimal values, "objective" among them, which is Cbc's own bound; empty if there are
  // none.
  std::map<std::string, double> solved(const std::filesystem::path& folder) const {
    std::ofstream lp(folder / "model.lp");
    lp.precision(17);
    lp << "Minimize\n cost:";
    for (const auto& [name, c] : cost_) lp << " + " << c << ' ' << name;
    lp << "\nSubject To\n" << rows_ << "Bounds\n" << bounds_;
    lp << "Binary\n" << whole_ << "End\n";
    lp.close();
    const auto path = folder.string();
    const std::string command =
        "cbc " + path +
        "/model.lp -increment 0 -ratioGap 0 -allowableGap 0 -primalTolerance 1e-9 "
        "-dualTolerance 1e-9 -solve -solution " +
        path + "/solution > " + path + "/log 2>&1";
    if (std::system(command.c_str()) != 0) return {};
    std::ifstream in(folder / "solution");
    std::string word, line;
    std::getline(in, line);
    if (!line.starts_with("Optimal")) return {};
    std::map<std::string, double> out;
    out["objective"] = std::stod(line.substr(line.rfind(' ')));
    while (std::getline(in, line)) {
      std::istringstream columns(line);
      std::string index, name;
      double value = 0;
      columns >> index >> name >> value;
      out[name] = value;
    }
    return out;
  }

 private:
  Terms cost_;
  std::string rows_, bounds_, whole_;
};

// A line c0 + c1 x.
struct Straight {
  double c0, c1;
};
template <class F>
Straight chord(double a, double b, F f) {
  const double slope = (f(b) - f(a)) / (b - a);
  return {f(a) - slope * a, slope};
}

class Witness {
 public:
  Witness(const Problem& m, const std::filesystem::path& folder)
      : m_(m), folder_(folder) {
    for (const char* x : {"Vr", "fr", "dr", "Vs", "fs", "ds"}) lp_.is_free(x);
    passes();
    pass("r", {{"Vr", 1}}, {{"fr", 1}}, {{"dr", 1}});
    pass("s", {{"Vs", 1}}, {{"fs", 1}}, {{"ds", 1}});
    lp_.at_most({{"fs", 2}}, std::log(8 * m.R_mm * m.SRu_um / 1000));
    if (m.VrU) lp_.at_most({{"Vr", 1}}, std::log(*m.VrU));
    ratio(m.k3, "Vs", "Vr");
    ratio(m.k4, "fr", "fs");
    ratio(m.k5, "dr", "ds");
    cost();
  }

  // Below every unit cost of the problem; none if no point keeps the limits.
  std::optional<double> bound() {
    for (int round = 0; round < kRounds; ++round) {
      const auto x = lp_.solved(folder_);
      if (x.empty()) return std::nullopt;
      double missing = 0;
      for (const auto& e : exponentials_) {
        double p = 0;
        for (const auto& [name, c] : e.power) p += c * (name.empty() ? 1 : at(x, name));
        missing += e.factor * (std::exp(p) - at(x, e.name));
        tangent(e, p);
      }
      if (missing < kMissing * x.at("objective")) return x.at("objective");
    }
    return std::nullopt;
  }

 private:
  struct Exponential {
    std::string name;
    double factor;
    Terms power;
  };

  static double at(const std::map<std::string, double>& x, const std::string& name) {
    const auto found = x.find(name);  // Cbc leaves out what is 0
    return found == x.end() ? 0 : found->second;
  }

  void ratio(double k, const char* more, const char* less) {
    if (k > 0) lp_.at_most({{less, 1}, {more, -1}}, -std::log(k));
  }
  void within(const Terms& x, const Range& range) {
    lp_.at_most(x, std::log(range.upper));
    lp_.at_most(-1 * x, -std::log(range.lower));
  }

  // (4) to (6) of one pass.
  void pass(const std::string& of, const Terms& V, const Terms& f, const Terms& d) {
    within(V, m_.V);
    within(f, m_.f);
    within(d, m_.d);
    life_[of] = Terms{{"", std::log(m_.C0)}} + -m_.p * V + -m_.q * f + -m_.r * d;
    within(life_[of], m_.T);
    const Terms force = Terms{{"", std::log(m_.kf)}} + m_.mu * f + m_.nu * d;
    lp_.at_most(force, std::log(m_.FU));
    lp_.at_most(force + V, std::log(m_.PU * 6120 * m_.eta));
    if (m_.SC > 0) lp_.at_most(-m_.lambda * V + -1 * f + -m_.nu2 * d, -std::log(m_.SC));
    lp_.at_most(Terms{{"", std::log(m_.kq)}} + m_.tau * V + m_.phi * f + m_.delta * d,
                std::log(m_.QU));
    time_[of] = Terms{{"", std::log(M_PI * m_.D_mm * m_.L_mm / 1000)}} + -1 * V + -1 * f;
  }

  // One cell of [lower, upper] is chosen, and `name` lies in it: `in_cell` is told the cell's
  // ends, the binary variable that chooses it and the part of `name` that belongs to it.
  template <class InCell>
  Terms cells(const std::string& id, double lower, double upper, InCell in_cell) {
    Terms chosen;
    for (int k = 0; k < kCells; ++k) {
      const double a = lower + (upper - lower) * k / kCells,
                   b = lower + (upper - lower) * (k + 1) / kCells;
      const std::string u = "u" + id + "_" + std::to_string(k),
                        y = "y" + id + "_" + std::to_string(k);
      lp_.is_whole(u);
      lp_.is_free(y);
      lp_.at_most({{y, 1}, {u, -b}}, 0);
      lp_.at_most({{y, -1}, {u, a}}, 0);
      chosen[u] = 1;
      in_cell(a, b, u, y);
    }
    return chosen;
  }

  // n dr + ds = dt, and ln n.
  void passes() {
    Terms one, dr{{"dr", -1}}, above{{"ds", -1}}, below{{"ds", 1}};
    for (int n = 1; n <= m_.n_max; ++n) {
      const double least = std::max(m_.d.lower, (m_.dt_mm - m_.d.upper) / n),
                   most = std::min(m_.d.upper, (m_.dt_mm - m_.d.lower) / n);
      if (!(least <= most)) continue;
      const auto ds = [&](double x) { return std::log(m_.dt_mm - n * std::exp(x)); };
      const Terms chosen =
          cells(std::to_string(n), std::log(least),
                std::log(std::max(most, least * (1 + 1e-9))),
                [&](double a, double b, const std::string& u, const std::string& y) {
                  const auto c = chord(a, b, ds);
                  const double x = (a + b) / 2, slope = -n * std::exp(x - ds(x));
                  dr[y] = 1;
                  above[u] = c.c0, above[y] = c.c1;
                  below[u] = -(ds(x) - slope * x), below[y] = -slope;
                });
      one = one + chosen;
      ln_n_ = ln_n_ + std::log(n) * chosen;
      idle_ = idle_ + m_.k0 * (m_.tc + (n + 1) * (m_.h1 * m_.L_mm + m_.h2)) * chosen;
    }
    lp_.equal(one, 1);
    lp_.equal(dr, 0);
    lp_.at_most(above, 0);
    lp_.at_most(below, 0);
  }

  // ln(theta Tr + (1 - theta) Ts) <= "mean".
  Terms mean_life() {
    const double s = std::log(m_.T.upper / m_.T.lower);
    Terms life = -1 * life_["r"] + Terms{{"mean", 1}};
    Terms ratio = -1 * life_["s"] + life_["r"];
    const auto f = [&](double x) {
      return std::log(m_.theta + (1 - m_.theta) * std::exp(x));
    };
    lp_.is_free("mean");
    const Terms chosen =
        cells("s", -s - 1e-9, s + 1e-9,
              [&](double a, double b, const std::string& u, const std::string& y) {
                const auto c = chord(a, b, f);
                ratio[y] = 1;
                life[u] = -c.c0, life[y] = -c.c1;
              });
    lp_.equal(chosen, 1);
    lp_.equal(ratio, 0);
    lp_.at_most(life, 0);
    return {{"mean", 1}};
  }

  void cost() {
    const bool literal = m_.cost == Cost::literal;
    const Terms mean = literal ? mean_life() : Terms{};
    const double change = m_.k0 * m_.te + m_.kt;
    for (const std::string of : {"r", "s"}) {
      const Terms time = of == "r" ? time_[of] + ln_n_ : time_[of];
      exponentials_.push_back({"time" + of, m_.k0, time});
      exponentials_.push_back(
          {"used" + of, change, time + -1 * (literal ? mean : life_[of])});
    }
    Terms all = idle_;
    for (const auto& e : exponentials_) {
      all[e.name] = e.factor;
      for (double p = -6; p < 4; p += 0.25) tangent(e, p);
    }
    lp_.objective(all);
  }

  // name >= exp(p) (1 + power - p).
  void tangent(const Exponential& e, double p) {
    lp_.at_most(Terms{{"", 1 - p}, {e.name, -std::exp(-p)}} + e.power, 0);
  }

  const Problem m_;
  std::filesystem::path folder_;
  LinearProgram lp_;
  Terms ln_n_, idle_;
  std::map<std::string, Terms> life_, time_;
  std::vector<Exponential> exponentials_;
};

class LinearWitness : public TemporaryFolder {
 protected:
  void SetUp() override {
    TemporaryFolder::SetUp();
    if (std::system("command -v cbc > /dev/null") != 0)
      GTEST_SKIP() << "cbc is not installed (coinor-cbc)";
  }

  void agree(const Problem& m) {
    const auto bound = Witness(m, folder_).bound();
    const auto answer = optimum(m);
    ASSERT_TRUE(bound);
    ASSERT_TRUE(answer.best);
    const double UC = *answer.best->UC;
    EXPECT_LE(*bound, UC * (1 + 1e-6));
    EXPECT_GE(*bound, UC * (1 - 2e-4));
  }
};

TEST_F(LinearWitness, BoundsTheLiteraturesProblemFromBelowAndClosely) {
  const std::vector<double> all{4, 5, 6, 7, 8, 9, 9.5, 10, 12, 14}, some{5, 8, 12};
  for (const double dt : std::getenv("TURNWRIGHT_SLOW") ? all : some)
    for (const Cost cost : {Cost::literal, Cost::physical}) {
      SCOPED_TRACE(dt);
      agree(literature(dt, cost));
    }
}

TEST_F(LinearWitness, BoundsTheVariantsInWhichOtherLimitsBind) {
  for (const auto& v : variants()) {
    SCOPED_TRACE(v.binds);
    agree(v.m);
  }
}

}  // namespace
}  // namespace turnwright::multipass
