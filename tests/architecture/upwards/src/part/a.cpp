#include "turnwright/planning/plan_request.hpp"
