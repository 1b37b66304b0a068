#pragma once
#include "turnwright/part/a.hpp"
