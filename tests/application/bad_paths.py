"""Broken loading paths for bad_input.py."""
from bad_cases import CASE, Bad, prm, SOUND

RIGID = {**SOUND["Loading"], "form": "path", "path": "p.csv"}


def path(name, text, *message, lateral="rigid", more=None):
    """A path file with this text and what must be said about it."""
    case = {section: dict(entries) for section, entries in SOUND.items()}
    case["Loading"] = RIGID
    case["Boundary"] = {"lateral": lateral}
    return Bad("path_" + name, CASE, list(message),
               files={"case.prm": prm(case), "p.csv": text, **(more or {})})


PATHS = [
    path("empty", "", "p.csv: ", "at least one stage"),
    path("no_stage", "name,duration_s\n", "p.csv: ", "at least one stage"),
    path("column", "name,axial_stres_Pa\na,1e5\n",
         "p.csv:1: \"axial_stres_Pa\"", "did you mean axial_stress_Pa?"),
    path("twice", "name,name\na,b\n", "p.csv:1: \"name\"", "once"),
    path("cells", "name,duration_s\na,1,2\n", "p.csv:2: ", "has 3 cells, must have 2"),
    path("number", "duration_s,axial_stress_Pa\n0.1,1e5x\n",
         "p.csv:2: axial_stress_Pa = 1e5x: ", "a number"),
    path("range", "duration_s,axial_stress_Pa\n0.1,-5\n",
         "p.csv:2: axial_stress_Pa = -5: ", "at least 0"),
    path("both", "duration_s,axial_stress_Pa,axial_strain_1\n0.1,1e5,0.1\n",
         "p.csv:2: axial_strain_1 = 0.1: ", "beside a stress"),
    path("length", "# none\nname,axial_stress_Pa\na,1e5\n",
         "p.csv:3: duration_s = (empty): ", "must be set"),
    path("too_much",
         "duration_s,axial_strain_1,axial_strain_rate_1_per_s\n1,0.1,0.1\n",
         "p.csv:2: axial_strain_rate_1_per_s = 0.1: "),
    path("wave", "wave,amplitude_Pa,frequency_Hz,cycles_1\nround,1e4,10,1\n",
         "p.csv:2: wave = round: ", "haversine, sine, square"),
    path("wave_alone", "wave,amplitude_Pa\nsine,1e4\n",
         "p.csv:2: frequency_Hz = (empty): ", "must be set beside a wave"),
    path("cycles", "wave,amplitude_Pa,frequency_Hz,cycles_1\nsine,1e4,9,1.5\n",
         "p.csv:2: cycles_1 = 1.5: ", "whole number"),
    path("no_wave", "duration_s,amplitude_Pa\n1,1e4\n",
         "p.csv:2: amplitude_Pa = 1e4: ", "without a wave"),
    path("driven_wave",
         "axial_strain_1,axial_strain_rate_1_per_s,wave,amplitude_Pa,"
         "frequency_Hz,cycles_1\n0.01,0.1,,,,\n,,sine,1e4,10,1\n",
         "p.csv:3: wave = sine: ", "axial_stress_Pa must be set"),
    path("rule", "duration_s,lateral_rule\n1,constant_q\n",
         "p.csv:2: lateral_rule = constant_q: ", "constant_p, constant_volume"),
    path("rule_and_stress",
         "duration_s,lateral_rule,lateral_stress_Pa\n1,constant_p,1e4\n",
         "p.csv:2: lateral_stress_Pa = 1e4: ", "beside lateral_rule"),
    path("volume", "duration_s,lateral_rule\n1,constant_volume\n",
         "p.csv:2: lateral_rule = constant_volume: ", "use rigid",
         lateral="membrane"),
    path("side_strain",
         "lateral_strain_1,lateral_strain_rate_1_per_s\n0.01,0.1\n",
         "p.csv:2: lateral_strain_1 = 0.01: ", "use rigid",
         lateral="membrane"),
    path("one_side", "duration_s,x_stress_Pa\n1,1e4\n",
         "p.csv:2: x_stress_Pa = 1e4: ", "use lateral", lateral="membrane"),
    path("table_missing",
         "wave,wave_file,amplitude_Pa,frequency_Hz,cycles_1\n"
         "table,w.csv,1e4,10,1\n", "p.csv:2: wave_file = w.csv: ",
         "no such file"),
    path("table",
         "wave,wave_file,amplitude_Pa,frequency_Hz,cycles_1\n"
         "table,w.csv,1e4,10,1\n", "p.csv:2: wave_file = w.csv: ", "w.csv:3: ",
         more={"w.csv": "share_1,value_1\n0,0\nx,1\n"}),
    path("many_cycles",
         "wave,amplitude_Pa,frequency_Hz,cycles_1\nsine,1,9,9e6\nsine,1,9,9e6\n",
         "p.csv:3: cycles_1 = 9e6: ", "at most 1e+07"),
    Bad("path_not_named", CASE, ["Loading/path = (empty)", "a CSV file"],
        {"Loading": {"form": "path"}}),
    Bad("path_missing", CASE, ["Loading/path = no.csv", "no such file"],
        {"Loading": {"form": "path", "path": "no.csv"}}),
]
