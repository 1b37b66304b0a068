#include "part/room/b.hpp"
