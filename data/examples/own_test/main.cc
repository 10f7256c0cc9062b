// The program of Spall with the kind of test "incline".
#include "incline_kind.h"

#include <program/program.h>

int main(int argc, char **argv)
{
  spall::add_test_kind(incline_kind());
  return spall::program_main(argc, argv);
}
