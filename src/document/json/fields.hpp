#pragma once
#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "reader.hpp"
#include "turnwright/base/language.hpp"
#include "turnwright/catalogue/machine.hpp"
#include "turnwright/catalogue/material.hpp"
#include "turnwright/catalogue/milling_cutter.hpp"
#include "turnwright/catalogue/tool.hpp"

/// Fields that are common to several kinds of documents.
namespace turnwright::document {

/// An id, which consists of at most 64 letters, digits and "_.+-".
std::string read_id(Reader& r, std::string_view key = "id");

/// The member "format", which must be `format` if present.  "$schema", which editors read,
/// is allowed beside it.
void read_format(Reader& r, const std::string& format);
void read_required_format(Reader& r, const std::string& format);

/// [lower, upper] with lower <= upper, both within `bounds`.
catalogue::Range read_range(Reader& r, std::string_view key, const Bounds& bounds);

/// "source", "note" and the returned "uncertainty_pct" of a group of numbers; refuses
/// other keys of the group that have not been read before.
double finish_group(Reader& group);

/// Eccentricities of a part that is held anew, by what holds it.
catalogue::Rechucking read_rechucking_by_jaws(Reader r);

const Choices<catalogue::IsoGroup>& iso_groups();

/// {"c0_mm_N", "c1_rad_N", "c2_rad_Nmm"}: a positive semi-definite compliance.
catalogue::RootCompliance read_compliance(Reader r);

/// Damping ratio of a mode of slender work or of a bar, "damping_ratio".
inline const Bounds kDamping = above_up_to(0, 0.5);

/// "currency", the name of one; empty if absent.
std::string read_currency(Reader& r);

/// Radius of a rounded cutting edge, "edge_um".
inline const Bounds kEdgeRadius = above_up_to(0, 500, "um");

/// "modes": {"axis": "x" along the feed or "y" across it, "frequency_Hz",
/// "damping_ratio", "stiffness_N_mm"}, one to ten of them.
std::vector<catalogue::TipMode> read_tip_modes(Reader& r);

/// A list of distinct words.
template <class E>
std::vector<E> read_set(Reader& r, std::string_view key, const Choices<E>& choices) {
  std::vector<std::string> words;
  for (const auto& [word, value] : choices) words.emplace_back(word);
  const auto items = r.items(key, 1, choices.size());
  std::vector<E> out;
  for (auto item = items.begin(); item != items.end(); ++item) {
    out.push_back(choices[item->as_choice(words)].second);
    const auto same = [&](const Reader& other) { return other.json() == item->json(); };
    if (std::any_of(items.begin(), item, same))
      item->problem(tr("each word once"), "duplicate");
  }
  return out;
}

}  // namespace turnwright::document
