#include "run/quantity_name.h"

#include <gtest/gtest.h>

using namespace spall;

TEST(QuantityName, IsWordsAndUnit)
{
  EXPECT_EQ(axis_label("permanent_axial_strain_1"),
            "Permanent axial strain (–)");
  EXPECT_EQ(axis_label("laa_percent"), "LAA (%)");
  EXPECT_EQ(axis_label("density_kg_per_m3"), "Density (kg/m³)");
  EXPECT_EQ(axis_label("plate_velocity_m_per_s"), "Plate velocity (m/s)");
  EXPECT_EQ(axis_label("solid_volume_m3"), "Solid volume (m³)");
  EXPECT_EQ(axis_label("n_events_1"), "Events (–)");
  EXPECT_EQ(axis_label("n_steps"), "Steps (–)");
  EXPECT_EQ(axis_label("initial_porosity"), "Initial porosity (–)");
}

TEST(QuantityName, KeysInWords)
{
  EXPECT_EQ(key_label("Loading/frequency", "Hz"), "Loading frequency (Hz)");
  EXPECT_EQ(key_label("Particle/friction", "-"), "Particle friction (–)");
  EXPECT_EQ(key_label("Variants", ""), "Variants");
}
