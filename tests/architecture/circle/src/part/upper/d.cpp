#include "part/lower/e.hpp"
