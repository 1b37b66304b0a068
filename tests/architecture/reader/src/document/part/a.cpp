#include "turnwright/document/b.hpp"
