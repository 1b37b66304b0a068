#pragma once
#include <array>
#include <complex>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "document/json/reader.hpp"

/// Universal files (SDRC I-DEAS): functions at nodes, dataset 58, in ASCII and binary (58b).
namespace turnwright::document {

/// Where and along which direction: 0 a scalar, 1 2 3 translation along x y z, 4 5 6
/// rotation, negative against it.
struct UniversalDof {
  long node = 0;
  int direction = 0;
  friend bool operator==(const UniversalDof&, const UniversalDof&) = default;
};
std::string text_of(const UniversalDof& dof);  ///< "7+Z"

/// What an axis holds: its specific data type (8 displacement, 11 velocity, 12
/// acceleration, 13 excitation force, 18 frequency) and its label of units, "" for NONE.
struct UniversalAxis {
  int type = 0;
  std::string units;
};

/// Length and force in the units of a file over those in m and N: dataset 164.
struct UniversalUnits {
  double length = 1, force = 1;
};

/// A dataset 58.
struct UniversalFunction {
  static constexpr int kResponse = 4, kCoherence = 6;
  std::size_t number = 0;  ///< among the datasets 58 of the file, from 1
  std::size_t line = 0;    ///< of its first record
  std::string name;        ///< ID line 1
  int type = 0;            ///< 4 frequency response, 6 coherence
  UniversalDof response, reference;
  bool complex = false;
  UniversalAxis abscissa, ordinate, denominator;
  std::optional<UniversalUnits> units;  ///< of the dataset 164 before it
  // Of frequency responses and coherences alone:
  std::vector<double> x;
  std::vector<std::complex<double>> y;
  std::vector<std::size_t> lines;  ///< line of each value
};

/// The functions of a file under `text`, which holds its text or the list of its lines.
/// Other datasets (151, 15, 2411 ..) are skipped.
///
/// Fields stand in the columns of the format: record 6 in 2(I5,I10),2(1X,10A1,I10,I4),
/// record 7 in 3I10,3E13.5, records 8 to 11 in I10,3I5,2(1X,20A1), values in 6E13.5, 4E20.12,
/// 2(E13.5,E20.12) or E13.5,2E20.12.  Numbers of records 7 and 12 that blanks divide may
/// stand anywhere; exponents may be written with D.  The values of a dataset 58b are bytes,
/// IEEE 754 of either order, behind its 11 lines; the text has a character from U+0000 to
/// U+00FF for each.  Its line is what counts as one of the file.
///
/// Reported, all of them, by line and column: no dataset; one that does not end; bytes of
/// another format; records that are cut off; numbers that cannot be read; an ordinate,
/// spacing or number of values that the format does not know; too few or too many values;
/// abscissae that do not rise.
/// Source: [SDRC 58], [SDRC 164].
std::vector<UniversalFunction> read_universal_file(const Reader& text);

}  // namespace turnwright::document
