#include "pmi.hpp"
#include "pmi_read.hpp"

namespace turnwright::exchange {

Pmi read_pmi(const Exchange& file) {
  Pmi pmi;
  Features features(file, pmi.unread);
  read_dimensions(file, features, pmi);
  read_datums(file, features, pmi);
  read_tolerances(file, features, pmi);
  read_textures(file, features, pmi);
  read_product(file, pmi);
  read_annotations(file, pmi);
  features.throw_if_spent();
  return pmi;
}

}  // namespace turnwright::exchange
