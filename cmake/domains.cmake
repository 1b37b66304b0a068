# Floor 1
tw_domain(base SOURCES errors.cpp)
# Floor 2
tw_domain(catalogue SOURCES iso1832.cpp DEPENDS base TESTS iso1832_test.cpp)
# Floor 3
# Floor 4
# Floor 5
# Floor 6
tw_domain(document SOURCES parse.cpp reader.cpp DEPENDS base
          PUBLIC_LIBS nlohmann_json::nlohmann_json TESTS parse_test.cpp reader_test.cpp)
# Floor 7, 8
