#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "turnwright/base/language.hpp"

namespace turnwright::document {

/// Languages of the program: "en", and the folders of languages/ in the data folder.
std::vector<std::string> languages(const std::filesystem::path& data_folder);

/// The texts of languages/<language>/*.json, objects of English text to translation; none
/// for "en".
/// @throws InputError if there is no such language, or a file is not such an object.
Translations translations(const std::filesystem::path& data_folder,
                          const std::string& language);

}  // namespace turnwright::document
