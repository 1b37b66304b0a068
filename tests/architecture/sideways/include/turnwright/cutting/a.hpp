#pragma once
#include "turnwright/milling/stability.hpp"
