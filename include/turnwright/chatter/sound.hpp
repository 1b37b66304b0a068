#pragma once
#include <optional>
#include <vector>

/// Chatter in the sound of a cut: what is left when the harmonics of the spindle are taken
/// out of its spectrum.
namespace turnwright::chatter {

struct Sound {
  double rate_Hz = 0;         ///< samples a second
  std::vector<double> value;  ///< of any unit
};

struct ListenOptions {
  double n_rpm = 0;             ///< spindle speed, known to a hundredth
  int teeth = 1;                ///< in turning 1
  double from_Hz = 50;          ///< lower frequencies are not looked at
  std::optional<double> to_Hz;  ///< nor higher ones; absent: all that are told apart
};

/// A line of the spectrum.
struct SoundLine {
  double frequency_Hz = 0;
  double amplitude = 0;      ///< of the sine
  double over_noise_dB = 0;  ///< its power over that of the noise about it
};

struct Harmonic {
  SoundLine line;
  int order = 0;  ///< of the spindle's frequency
};

struct Heard {
  double n_rpm = 0;          ///< of the harmonics; as given if there are none
  double resolution_Hz = 0;  ///< 1/length of a block
  double from_Hz = 0, to_Hz = 0;
  std::vector<Harmonic> harmonics;  ///< that stand out, the strongest first
  std::vector<SoundLine> others;    ///< that stand out and are none, the strongest first
  std::optional<SoundLine> chatter;
};

/// The spectrum is the mean of those of blocks of 32 revolutions (at least 0.25 s), weighted
/// by Hann's window, half over each other.  Noise is the median of the lines about a line,
/// over ln 2, harmonics left out.  A line stands out if it is 15 dB above the noise: white
/// noise does so in one line of e^31.  Lines are looked for up to half the rate less four
/// lines of resolution; nearer, a line and its mirror image are one.
///
/// All multiples of the spindle's frequency count as harmonics, not only those of the teeth,
/// because teeth run out.  The speed is found from them, the low orders first.  What lies
/// within 2.5 lines of resolution and 5e-4 of the frequency about one is not told from it;
/// `to_Hz` ends where these ranges take 0.8 of all.
///
/// The strongest other line is chatter if its amplitude is a tenth of the strongest
/// harmonic's at least, or if there is no harmonic.  The frequency is that of the parabola
/// through the logarithms of the highest values.
///
/// Neglects: chatter that doubles the period (a flip) of an even number of teeth lies on
/// harmonics of the spindle and is not heard; neither is chatter that happens to lie within
/// those ranges.  What sounds above half the rate and is not filtered out before it is
/// sampled is heard as far below it.  A fan or a pump may be taken for chatter: listen to an
/// idle cut, too.
/// Source: derived here, checked in sound_test on simulated sounds.
/// @throws ModelRangeError if the sound is shorter than 16 revolutions or 0.05 s, or if 16
///   revolutions have more than 2^20 samples, the most of a block.
Heard listen(const Sound& sound, const ListenOptions& options);

/// A speed at which a vibration keeps step with the teeth.
struct SteadySpeed {
  double n_rpm = 0;
  int harmonic = 0;  ///< k: vibrations from tooth to tooth
};

/// n = 60 f/(z k): the teeth meet the same phase of the waves, so that the chip does not
/// vary.  The two next slower and the two next faster ones, the nearest in ratio first; k =
/// 1 is the fastest.
std::vector<SteadySpeed> steady_speeds(double chatter_Hz, double n_rpm, int teeth);

}  // namespace turnwright::chatter
