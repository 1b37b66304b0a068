# Floor 1
tw_domain(base SOURCES errors.cpp)
# Floor 2
# Floor 3
# Floor 4
# Floor 5
# Floor 6
# Floor 7, 8
