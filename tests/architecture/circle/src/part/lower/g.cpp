#include "part/upper/f.hpp"
