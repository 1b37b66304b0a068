#pragma once
#include "notation_demands.hpp"

/// An element of the contour or of a bore, as a notation says it.
namespace turnwright::exchange::notated {

/// Whether a statement that begins with this word is an element.
bool begins_element(Word word);

struct ReadElement {
  Element element;  ///< without its id
  bool inner = false;
};

/// The element of a statement; what is wrong with it goes to `mistakes`.
ReadElement element(const std::vector<Word>& words, Mistakes& mistakes);

}  // namespace turnwright::exchange::notated
