#pragma once

#include <cassert>

/// Programmer errors, checked in debug builds only.
#define DEM_ASSERT(condition) assert(condition)
