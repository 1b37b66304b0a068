#pragma once
#include "notation_demands.hpp"

/// Faces, tolerances and milled places of a notation, which name elements by their ids.
namespace turnwright::exchange::notated {

/// An id that a statement names, to be looked up once all elements are read.
struct Named {
  Word word;
  bool face_too = false;  ///< "left", "right" or "d1|d2" will do as well
};

/// What the statements say beside the elements, and whom they name.
struct Features {
  std::vector<FaceOf> faces;
  std::vector<part::Tolerance> tolerances;
  std::vector<Milled> milled;
  std::vector<Named> named;
};

/// Reads a statement that begins with "face", a kind of tolerance or of a milled place.
/// @return false if it begins with none of them.
bool read_feature(const std::vector<Word>& words, Features& features, Mistakes& mistakes);

}  // namespace turnwright::exchange::notated
