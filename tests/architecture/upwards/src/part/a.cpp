#include "turnwright/planning/part_plan.hpp"
