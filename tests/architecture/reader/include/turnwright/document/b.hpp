#pragma once
#include "turnwright/planning/plan_request.hpp"
#include "turnwright/planning/prepared_part.hpp"
