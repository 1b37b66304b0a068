#pragma once
#include <string_view>

#include "parameters.hpp"
#include "words.hpp"

/// Expressions in programs, as LinuxCNC, Fanuc, Siemens and Okuma reckon.
///
///     LinuxCNC   **;  * / MOD;  + -;  EQ NE GT GE LT LE;  AND OR XOR, of truths
///     Fanuc      * / AND MOD;  + - OR XOR, of whole numbers;  EQ NE GT GE LT LE
///     Siemens    NOT B_NOT;  * / DIV MOD;  + -;  B_AND;  B_XOR;  B_OR;  AND;  XOR;
///                OR, of truths;  == <> > < >= <=
///     Okuma      * /;  + -;  EQ NE GT GE LT LE;  AND OR EOR, of truths
///
/// Operators of one rank go from left to right; a sign belongs to the value behind it, so
/// that -2**2 = 4.  Functions take brackets: ABS ACOS ASIN ATAN COS EXP FIX FUP LN ROUND
/// SIN SQRT TAN, of LinuxCNC EXISTS, of Fanuc also SQR, RND and POW[a,b]; angles are in
/// degrees, ATAN[y]/[x] in -180 to 180 deg.  FIX and FUP round towards the smaller and the
/// larger number in LinuxCNC, towards 0 and away from it in Fanuc; MOD has the sign of the
/// dividend in Fanuc and none in LinuxCNC, where EQ and NE allow 1e-4.  A vacant variable
/// counts as 0 but for EQ and NE, which tell it from 0.
///
/// Siemens' functions take ( ): ABS ACOS ASIN COS EXP LN POT (the square) ROUND SIN SQRT
/// TAN TRUNC, ATAN2(y,x), MINVAL(a,b), MAXVAL(a,b), BOUND(least,most,a); it has TRUE, FALSE
/// and numbers such as 10EX-5, and compares by shares of the values, here 1e-12.
/// Okuma's take [ ]: ABS ACOS ASIN ATAN COS FIX FUP ROUND SIN SQRT TAN, ATAN2[y,x],
/// MOD[a,b].
/// Source: [LinuxCNC], which linuxcnc_test runs; of Fanuc [gEdit], of Siemens [Siemens PGA],
/// of Okuma [Okuma user task] in docs/bibliography.md; Okuma's ranks are taken as usual.
namespace turnwright::review {

/// The value of an expression; vacant only for a vacant variable alone.
/// @throws NotFollowed for what is no expression, has no value (a root of -1, 1/0) or
/// hangs on a variable that the program does not tell.
Value value_of(std::string_view expression, const Parameters& parameters);

/// The value between the brackets in which a text begins; `end` is behind them.
double bracketed_value(std::string_view text, const Parameters& parameters,
                       std::size_t& end);

/// Sets a variable, "#1", "R[R2]", "depth".
/// @throws NotFollowed if the program cannot.
void set_variable(Parameters& parameters, std::string_view variable, const Value& value);

/// Gives words their values and drops those whose value is vacant, then sets variables.
void evaluate(Block& block, Parameters& parameters);

}  // namespace turnwright::review
