#include "turnwright/deflection/beam.hpp"

#include <gtest/gtest.h>
