#include "problem_list.hpp"

namespace turnwright::service {

nlohmann::ordered_json problem_list(const std::vector<Problem>& problems) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& problem : problems)
    list.push_back({{"pointer", problem.pointer},
                    {"got", problem.got},
                    {"expected", problem.expected},
                    {"code", problem.code}});
  return list;
}

}  // namespace turnwright::service
