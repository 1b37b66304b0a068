#pragma once
#include <initializer_list>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "pmi.hpp"
#include "pmi_feature.hpp"
#include "turnwright/base/errors.hpp"

/// What the readers of the kinds of PMI share.
namespace turnwright::exchange {

/// All instances with a record of one of these names, each once, in the order of the file.
std::vector<Instance> instances_of(const Exchange& file,
                                   std::initializer_list<std::string_view> names);

/// The last `n` parameters of a record: where the attributes of a subtype stand, alone or in
/// a complex instance.  Parameter i of them, from 0.
/// @throws InputError if the record has fewer.
Parameter of_last(const Record& record, std::size_t n, std::size_t i);

/// The items of a representation, those within compound items too.
/// @throws InputError if there are more than `most`.
std::vector<Instance> representation_items(const Instance& representation,
                                           std::size_t most);

/// Everything that a list, a typed list or a reference leads to, in its order.
/// @throws InputError if it is more than `most`.
std::vector<Instance> references(
    const Parameter& parameter,
    std::size_t most = std::numeric_limits<std::size_t>::max());

/// A text that many may share, so that it has to be short; "" if it is absent.
/// @throws InputError if it has more than 200 bytes.
std::string short_text(const Parameter& parameter);
/// An enumeration in words: "maximum material requirement".
/// @throws InputError as short_text.
std::string in_words(const Parameter& enumeration);

/// A length in mm, rounded to 1e-9 mm: converters leave 0.00500000000002 inches behind.
/// @throws InputError if the instance is no length, or 10 km and more.
double length_mm(const Instance& measure);
double rounded_mm(double x_mm);

std::string lower_case(std::string text);

/// Why something could not be read, as a sentence.
std::string reason(const InputError& error);

/// Reads one instance; what is broken in it is told and costs nothing else.
template <class Read>
void read_or_tell(const Instance& at, std::vector<Remark>& unread, Read&& read) {
  try {
    read(at);
  } catch (const InputError& error) {
    unread.push_back({name_of(at.id()), reason(error)});
  }
}

void read_dimensions(const Exchange& file, Features& features, Pmi& pmi);
/// After the datums, of which it takes the letters.
void read_tolerances(const Exchange& file, Features& features, Pmi& pmi);
/// What zones and relations add to the tolerances already read: their form, modifiers.
void read_zones(const Exchange& file, Pmi& pmi);
void read_datums(const Exchange& file, Features& features, Pmi& pmi);
void read_textures(const Exchange& file, Features& features, Pmi& pmi);
void read_product(const Exchange& file, Pmi& pmi);
void read_annotations(const Exchange& file, Pmi& pmi);

}  // namespace turnwright::exchange
