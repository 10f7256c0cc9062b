#pragma once

#include <case/kind.h>

/// Parameters of the section Incline.
struct InclineParameters
{
  double angle = 20.;    ///< of the plane against the horizontal [degrees]
  double radius = 0.01;  ///< of the sphere [m]
  double duration = 0.2; ///< [s]
  int rows = 100;        ///< of history.csv
};

/// A sphere that rolls down an inclined plane: a kind of test from outside of
/// the program. `add_test_kind(incline_kind())` registers it.
spall::TestKind incline_kind();
