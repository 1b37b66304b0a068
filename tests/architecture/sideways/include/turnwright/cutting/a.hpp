#pragma once
#include "turnwright/chatter/stability.hpp"
