#pragma once

#include "case.h"

namespace spall::verify
{
// One file each.
Family laws();
Family impacts();
Family rolling();
Family integration();
Family shape();
Family breakage();
Family membrane();
Family coupling();
Family network();

/// All of them, in the order of the table.
const std::vector<Family> &families();
} // namespace spall::verify
