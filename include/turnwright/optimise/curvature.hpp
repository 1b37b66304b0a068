#pragma once

namespace turnwright::optimise {

/// A scalar that knows nothing but its curvature: what a positive function is of the
/// logarithms of its variables.  A model written over a scalar type, evaluated with this
/// one, proves its own log-convexity by the rules of its construction:
///
///     variable                      affine
///     constant > 0                  constant
///     u v, u^p (p >= 0), c u        the more curved of the factors        (posynomials
///     u + v, max(u, v)              convex                                 are closed)
///     u / v, u^p (p < 0)            as above if the divisor is affine or constant
///     u - v, min(u, v), other       unknown
///
/// `unknown` is no claim at all.  Source: Boyd et al., "A tutorial on geometric
/// programming" (2007), generalized posynomials; the rules are the disciplined ones.
class LogCurvature {
 public:
  enum class Kind { constant, affine, convex, unknown };

  LogCurvature() : kind_(Kind::unknown) {}
  LogCurvature(double value)  // NOLINT: a number is a constant
      : kind_(value > 0 ? Kind::constant : Kind::unknown) {}
  explicit LogCurvature(Kind kind) : kind_(kind) {}

  static LogCurvature variable() { return LogCurvature(Kind::affine); }
  Kind kind() const { return kind_; }
  bool convex() const { return kind_ != Kind::unknown; }
  bool affine() const { return kind_ == Kind::constant || kind_ == Kind::affine; }

  friend LogCurvature operator*(LogCurvature a, LogCurvature b) { return worse(a, b); }
  friend LogCurvature operator/(LogCurvature a, LogCurvature b) {
    return b.affine() ? worse(a, b) : LogCurvature();
  }
  friend LogCurvature operator+(LogCurvature a, LogCurvature b) { return sum(a, b); }
  friend LogCurvature operator-(LogCurvature, LogCurvature) { return {}; }
  friend LogCurvature operator-(LogCurvature) { return {}; }
  friend LogCurvature max(LogCurvature a, LogCurvature b) { return sum(a, b); }
  friend LogCurvature min(LogCurvature, LogCurvature) { return {}; }
  friend LogCurvature pow(LogCurvature a, double p) {
    return p >= 0 || a.affine() ? a : LogCurvature();
  }
  friend LogCurvature sqrt(LogCurvature a) { return a; }
  friend LogCurvature sqr(LogCurvature a) { return a; }
  template <class Below, class Above>
  friend LogCurvature branch(LogCurvature, double, const Below&, const Above&) {
    return {};
  }

 private:
  static LogCurvature worse(LogCurvature a, LogCurvature b) {
    return a.kind_ < b.kind_ ? b : a;
  }
  static LogCurvature sum(LogCurvature a, LogCurvature b) {
    if (!a.convex() || !b.convex()) return {};
    const bool constants = a.kind_ == Kind::constant && b.kind_ == Kind::constant;
    return LogCurvature(constants ? Kind::constant : Kind::convex);
  }
  Kind kind_;
};

}  // namespace turnwright::optimise
