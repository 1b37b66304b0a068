#include "turnwright/cutting/estimate.hpp"

namespace turnwright::cutting {

void Evidence::rename(const std::vector<std::size_t>& names) {
  for (auto* list : {&used, &outliers})
    for (std::size_t& i : *list) i = names[i];
}

}  // namespace turnwright::cutting
