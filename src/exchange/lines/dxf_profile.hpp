#pragma once
#include "dxf_half.hpp"
#include "turnwright/exchange/dxf.hpp"
#include "turnwright/exchange/profile.hpp"

/// The half profile that a DXF drawing shows.
namespace turnwright::exchange::dxf {

struct ProfileRead {
  Profile profile;
  View view;
  std::vector<Remark> assumed, ignored;
};

/// @throws InputError as read_dxf does.
ProfileRead profile_of(const Drawn& drawn, double join_mm);

}  // namespace turnwright::exchange::dxf
