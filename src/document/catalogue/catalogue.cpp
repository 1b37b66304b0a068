#include "turnwright/document/catalogue.hpp"

#include <algorithm>
#include <string>
#include <type_traits>

#include "catalogue_readers.hpp"
#include "document/json/file.hpp"
#include "shop.hpp"
#include "turnwright/base/language.hpp"

namespace turnwright::document {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> json_files(const fs::path& folder) {
  std::vector<fs::path> files;
  if (!fs::is_directory(folder)) return files;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  std::sort(files.begin(), files.end());  // the same order of problems everywhere
  return files;
}

template <class Read>
auto load_folder(const fs::path& folder, Problems& problems, const Read& read) {
  using T = std::invoke_result_t<Read, Reader>;
  std::vector<T> out;
  for (const auto& file : json_files(folder)) {
    const std::string root = (folder.filename() / file.filename()).generic_string() + '#';
    try {
      const auto json = parse_file(file, root);
      const Reader reader(json, problems, root);
      T entry = read(reader);
      const bool twice = std::any_of(out.begin(), out.end(), [&](const T& earlier) {
        return !entry.id.empty() && earlier.id == entry.id;
      });
      if (twice) reader.problem_at("id", tr("an id no other file has"), "duplicate");
      out.push_back(std::move(entry));
    } catch (const InputError& error) {
      for (auto problem : error.problems()) {
        problem.pointer = root + problem.pointer;
        problems.add(std::move(problem));
      }
    }
  }
  std::sort(out.begin(), out.end(), [](const T& a, const T& b) { return a.id < b.id; });
  return out;
}

}  // namespace

Catalogue load_catalogue(const fs::path& folder) {
  Problems problems{.document = folder.string()};
  Catalogue all;
  all.materials = load_folder(folder / "materials", problems, [&](const Reader& r) {
    auto material = read_material(r);
    all.material_documents[material.id] = r.json();
    return material;
  });
  all.tools = load_folder(folder / "tools", problems, read_tool);
  all.fixed_tools = load_folder(folder / "tools" / "fixed", problems, read_fixed_tool);
  all.cutters = load_folder(folder / "tools" / "milling", problems, read_milling_cutter);
  all.machines = load_folder(folder / "machines", problems, [&](const Reader& r) {
    auto machine = read_lathe(r);
    all.machine_documents[machine.id] = r.json();
    return machine;
  });
  const auto known = targets_of(all);
  all.shops = load_folder(folder / "shops", problems,
                          [&](const Reader& r) { return read_shop(r, known); });
  problems.throw_if_any();
  return all;
}

}  // namespace turnwright::document
