#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "document/json/reader.hpp"
#include "turnwright/document/catalogue.hpp"
#include "turnwright/document/loaded_part.hpp"

/// The sections of a part document, read one after the other into a draft.
namespace turnwright::document {

inline const Bounds kSize = above_up_to(0, 20000, "mm");  ///< of a part

struct Draft {
  Reader& root;
  const Catalogue& catalogue;
  Purpose purpose = Purpose::plan;
  LoadedPart loaded = {};
  std::vector<catalogue::MillingCutter> cutters = {};  ///< of the request, or all
  std::vector<catalogue::Tool> undercut_tools = {};    ///< see add_tools_for_undercuts
  /// What turning leaves for grinding on the diameters of elements [mm], by their ids, or
  /// leaves off for knurling, which is negative; the drawing has the turned diameters.
  std::map<std::string, double> ground_mm = {};

  planning::PlanRequest& plan() { return loaded.plan; }
  part::Drawing& drawing() { return loaded.plan.drawing; }
  double ground(const std::string& id) const {
    const auto found = ground_mm.find(id);
    return found == ground_mm.end() ? 0 : found->second;
  }
  void assume(std::string pointer, nlohmann::json value, std::string why) {
    loaded.assumed.push_back({std::move(pointer), std::move(value), std::move(why)});
  }
};

void read_catalogue_choices(Draft& draft);  // material, machine, tools
void read_elements(Draft& draft);           // outer, inner, faces
/// Lists sizes and roughness of a surface that is made at catalogue conditions under
/// `assumed`: they are not judged.
/// @param to_middle  sizes are cut to the middle of their limits
void leave_to_the_tool(Draft& draft, Reader& element, bool to_middle);
/// An element that was read as a plain one is made at catalogue conditions instead.
template <class Element>
void make_at_catalogue_conditions(Draft& draft, Reader item, Element& e,
                                  const part::Cut& cut) {
  leave_to_the_tool(draft, item, cut.kind == part::CutKind::groove);
  e.fit.reset();
  e.limits.reset();
  e.Ra_um.reset();
  e.Rz_um.reset();
  e.cut = cut;
}
/// A groove, thread or arc; a groove's blank waits for the elements beside it.
void read_cut(Draft& draft, Reader& r, part::OuterElement& e, part::CutKind kind);
void read_cut(Draft& draft, Reader& r, part::InnerElement& e, part::CutKind kind);
/// The blanks of grooves are cut as low as what is drawn as high beside them.
void give_grooves_their_limits(Draft& draft);  // after the tolerances
void give_grooves_their_blanks(Draft& draft, const std::vector<Reader>& outer,
                               const std::vector<Reader>& inner);
/// The index of the element whose diameter a groove's blank has, in either list.
std::optional<std::size_t> beside(const std::vector<part::OuterElement>& list,
                                  std::size_t groove);
std::optional<std::size_t> beside(const std::vector<part::InnerElement>& list,
                                  std::size_t groove);
void read_stock(Draft& draft);  // after the elements
/// The outer diameter [mm] of a part document's stock, as elements that stay as the stock is
/// have it; not finite where the stock does not say it.
double outer_of_stock_mm(const nlohmann::json& part);
/// Whether the stock and all elements, of which there are outer ones, have lengths and
/// diameters.
bool sizes_were_read(const part::Drawing& drawing);
void check_bores(Draft& draft);  // after the stock
void read_edges(Draft& draft);   // after the stock
/// The innermost bore of each end of a bar, too narrow for the boring bars, where a drill
/// leaves it as it is drawn, becomes a hole; nothing else is asked of it, and the operations
/// are the planner's.
void read_drilled_holes(Draft& draft);  // after the edges
void read_centre_holes(Draft& draft);   // after the bores
void read_general_edges(Draft& draft);  // after all other edges and the holes
/// Tools whose edge goes behind shoulders serve, where the request lists none, only drawings
/// with undercuts that ask for it: the force law is not compared with cuts at such angles.
void add_tools_for_undercuts(Draft& draft);  // after the edges
void read_tolerances(Draft& draft);          // sizes, general, tolerances
void read_setups(Draft& draft);
void read_operations(Draft& draft);  // after the setups
void read_milling(Draft& draft);     // after the setups
void read_what_if(Draft& draft);     // the form alone

// Targets of cross-references.

/// fixed: a groove, thread or arc, or what stays as the stock is; wall: a shoulder between
/// bores, which is a face too
enum class Feature { cylinder, cone, face, fixed, wall };
inline bool is_face(Feature feature) {
  return feature == Feature::face || feature == Feature::wall;
}
struct NamedFeature {
  std::string id;
  Feature feature;
};
/// Elements, then faces ("left", "right", the outer and the inner shoulders, these by both
/// orders of their bores).  Empty if an element's id could not be read, so that references
/// cannot be checked.
std::vector<NamedFeature> features(const part::Drawing& drawing);

/// The id of a face as the drawing has it: of a shoulder between bores the wider one first.
/// One that a drill makes is a problem of the value that names it.
std::string checked_wall(const Reader& value, const part::Drawing& drawing,
                         std::string id);

/// The number of digits with a decimal point or comma, as designations have it.
double decimal(std::string digits);

/// "limits_mm": deviations [lower, upper] of a size, lower < upper.
part::Limits read_limits(Reader& r);

/// The words of an enum whose values have a name().
template <class E>
Choices<E> named(std::initializer_list<E> all) {
  Choices<E> out;
  for (const E value : all) out.emplace_back(name(value), value);
  return out;
}

const Choices<part::End>& ends();

}  // namespace turnwright::document
