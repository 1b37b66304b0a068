#pragma once
#include <optional>
#include <string>
#include <vector>

#include "turnwright/planning/prepared_part.hpp"

/// The surfaces that setups make, as they are assigned, and the part they leave.
namespace turnwright::planning {

/// Which elements have their final diameters; the others are stock.
struct Finished {
  std::vector<bool> outer, inner;
};
Finished nothing_finished(const part::Drawing& drawing);
/// Adds all surfaces that a setup cuts.
void finish(Finished& finished, const SetupWork& work);

/// One element, outer or inner.
struct Element {
  bool inner = false;
  std::size_t index = 0;
};

/// "d1|d2": the face between outer elements k-1 and k.
std::string shoulder_id(const part::Drawing& drawing, std::size_t k);
/// Whether the wall of the shoulder between outer elements k-1 and k is made in one pass
/// with the undercut at its foot: nothing is asked of it but roughness, so it is not faced
/// by itself.
bool made_with_undercut(const part::Drawing& drawing, std::size_t k);
/// Diameters [mm] between which a shoulder lies, outside or between two bores; nothing for
/// another surface.
struct Ring {
  double small_mm = 0, large_mm = 0;
  bool inner = false;
};
std::optional<Ring> shoulder_ring(const part::Drawing& drawing, const std::string& face);
/// Whether a setup faces the shoulder between two bores by itself.
bool faces(const SetupWork& work, const part::InnerShoulder& shoulder);
/// The surface whose operation makes a surface: of a shoulder between bores that no
/// tolerance is on the wider one, else itself.
std::string cut_with(const part::Drawing& drawing, const std::string& surface);
/// The setup that makes an element or face; none if it stays as it is in the stock.
std::optional<std::size_t> setup_of(const PreparedPart& part, const std::string& surface);
/// z [mm] of the face "left", "right" or of a shoulder.
double face_z_mm(const part::Drawing& drawing, const std::string& face);

/// Elements with their final diameters once a setup is done.
Finished finished_after(const PreparedPart& part, std::size_t setup);

/// Material [mm] before the finished face of an end once a setup is done: none if the end
/// was faced by then.
double face_stock_after_mm(const PreparedPart& part, std::size_t setup, part::End end);

/// Diameter [mm] of the hole in which boring of an inner element starts: that of the
/// stock or of the drill.
double hole_mm(const PreparedPart& part, std::size_t inner);

}  // namespace turnwright::planning
