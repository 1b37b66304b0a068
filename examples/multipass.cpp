// The literature's multi-pass turning problem: its cheapest passes, with proof.
#include <cstdio>

#include "turnwright/multipass/problem.hpp"

int main() {
  using namespace turnwright::multipass;
  const Answer answer = optimum({.dt_mm = 8, .cost = Cost::literal, .PU = 5});
  if (!answer.best) return 1;
  const auto& [n, status, UC, bound, rough, finish, nodes] = *answer.best;
  std::printf("%d roughing passes: %.1f m/min, %.3f mm/rev, %.2f mm deep\n", n, rough.V,
              rough.f, rough.d);
  std::printf("finishing: %.1f m/min, %.3f mm/rev, %.2f mm deep\n", finish.V, finish.f,
              finish.d);
  std::printf("cost %.4f per piece, nothing below %.4f\n", *UC, answer.lower_bound);
}
