#pragma once

#include "case.h"

namespace spall::verify
{
// oblique_impacts.cc
std::vector<Row> chung_ooi_4_sliding();
std::vector<Row> chung_ooi_4_sticking();
std::vector<Row> chung_ooi_5();
std::vector<Row> chung_ooi_6();
std::vector<Row> chung_ooi_7();
std::vector<Row> chung_ooi_8();
} // namespace spall::verify
