#pragma once
#include <optional>

#include "modal_state.hpp"
#include "words.hpp"

/// Words and moves of driven tools, with the main spindle as an axis.
namespace turnwright::review {

/// What a word says about them.
struct MillingWord {
  enum class What {
    begins,     ///< the spindle is an axis, or a driven tool turns
    ends,       ///< the spindle turns the part again
    speed,      ///< of the driven tool [1/min]
    stops,      ///< the driven tool
    plane,      ///< X and C are a plane (G12.1, TRANSMIT)
    cylinder,   ///< C is a length around the part (G7.1, TRACYL)
    plane_ends  ///< either
  };
  What what;
  double value = 0;
};

/// By control: Haas M154, M155, M133, M134, M135; Okuma M110, M109, M13, M14, M12, SB,
/// G137, G136; Siemens S2=, M2=, TRANSMIT, TRACYL, TRAFOOF; Fanuc and Haas G12.1, G112,
/// G13.1, G113, G7.1, G107.
/// Source: [Milling words] in docs/bibliography.md; G12.1, G7.1 and G137 from knowledge of
/// the controls.
std::optional<MillingWord> milling_word(gcode::Control control, const Word& word);

/// Does what a word says.
void take_up(ModalState& s, const MillingWord& word);

/// Whether a block's axes C, Y or H belong to a driven tool: not where the spindle turns and
/// the tool feeds, which is the phase of a thread or a chamfer, nor where Y stays on the axis.
bool begins_milling(const ModalState& s, gcode::Control control, int motion,
                    const Block& block);

/// A move by G0 to G3 of a driven tool, with C and Y.  A feed of C alone waits for its
/// degrees, an arc that leaves the plane of X and Z for what it is longer than its chord.
/// @return false for an arc in that plane, which is not made.
bool driven_move(ModalState& s, gcode::Control control, int motion, const Block& block,
                 std::optional<double> x_mm, std::optional<double> z_mm);

}  // namespace turnwright::review
