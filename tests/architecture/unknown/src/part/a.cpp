#include "turnwright/elsewhere/b.hpp"
