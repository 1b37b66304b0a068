#pragma once
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "contour_cycle.hpp"
#include "modal_state.hpp"
#include "parameters.hpp"

/// Siemens' cycles that are called by name, as plain moves:
///
///     CYCLE81(RTP,RFP,SDIS,DP,DPR)                          a hole in one feed
///     CYCLE82(..,DTB)                                       waits at its bottom
///     CYCLE83(..,FDEP,FDPR,DAM,DTB,DTS,FRF,VARI,_AXN,_MDEP,_VRT,_DTD,_DIS1)   in strokes
///     CYCLE84(..,DTB,SDAC,MPIT,PIT,POSS,SST,SST1)           a tap
///     CYCLE840(..,DTB,SDR,SDAC,ENC,MPIT,PIT)                a tap that gives way
///     CYCLE85(..,DTB,FFR,RFF)                               back at feed
///     CYCLE95(NPP,MID,FALZ,FALX,FAL,FF1,FF2,FF3,VARI,DT,DAM,_VRT)   stock removal
///     CYCLE97(PIT,MPIT,SPL,FPL,DM1,DM2,APP,ROP,TDEP,FAL,IANG,NSP,NRC,NID,VARI,NUMT,_VRT)
///
/// Drilling is followed on the axis.  Strokes of CYCLE83: the first to FDEP, each one less by
/// DAM, or DAM < 0 of it, and not less than _MDEP, or DAM; out to the place before the surface
/// and back to _DIS1 before the depth reached (VARI 1), or back by _VRT (VARI 0).  Cuts of a
/// thread: NRC of one section (VARI 3, 4) or one depth (1, 2), FAL in another, NID that cut
/// nothing.
/// Source: [Siemens PGZ] and [Siemens 808D] in docs/bibliography.md; kinds of CYCLE95 and
/// strokes of DAM > 0 from knowledge of the cycles, not opened.
namespace turnwright::review {

class SiemensCycles {
 public:
  /// The contour of a subprogram, or of a section between two labels.
  using ContourOf = std::function<std::optional<Contour>(std::string_view name)>;

  /// Whether a text calls one of them.
  static bool knows(std::string_view text);
  /// Makes the moves of the call.
  /// @throws NotFollowed if its values cannot be followed.
  static void take(ModalState& s, const Parameters& parameters, std::string_view text,
                   const ContourOf& contour_of);
};

}  // namespace turnwright::review
