#pragma once

#include "case/case.h"

#include <dem/packing/container.h>

#include <memory>

namespace spall
{
/// The container of Container/mesh; null without. Throws InputError on a file
/// that is none.
std::shared_ptr<const dem::Container> container_of_mesh(const Case &parameters);

/// Checks Container/mesh against the rest of the case. Throws InputError.
void check_container_mesh(const Case &c, const SourceLocation &location);
} // namespace spall
