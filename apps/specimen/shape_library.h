#pragma once

#include "case/case.h"
#include "shape/file.h"

#include <dem/shape/particle_shape.h>

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace spall
{
/// The shapes that particles of a run share until they break, and what files
/// say of each.
class ShapeLibrary
{
public:
  using Series = std::shared_ptr<const dem::Coefficients>;

  /// What is known of a shape besides its series.
  struct Entry
  {
    std::string name; ///< of its file, without ending
    std::string source, licence;
  };

  /// `file` is where the series is from.
  void add(Series shape, const ShapeFile &file);

  std::size_t size() const { return all.size(); }
  bool empty() const { return all.empty(); }
  const Series &operator[](std::size_t k) const { return all[k]; }
  auto begin() const { return all.begin(); }
  auto end() const { return all.end(); }
  const Series &back() const { return all.back(); }
  const Entry &entry(std::size_t k) const { return entries[k]; }
  /// The series alone, as the engine takes them.
  const std::vector<Series> &series() const { return all; }

private:
  std::vector<Series> all;
  std::vector<Entry> entries;
};

/// The shapes of a folder that the key `shapes` of this section names, cut at
/// an order (loaded_shape()); empty: none. Throws InputError.
ShapeLibrary load_shapes(const Case &parameters, const std::string &section,
                         const std::string &folder, int order = dem::max_order);
} // namespace spall
