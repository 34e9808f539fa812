"""Which test programs can see a mutant of which folder, in the order they are asked: those of the folder itself first.

A program of the second list is asked only when none of the first has told. Those that need root, other processes or real time
are not in here: what only they can see counts as a survivor.
"""

SYSTEMS = ["test_system_positions", "test_system_steered", "test_system", "test_system_canopen", "test_system_devicenet", "test_system_interbus", "test_system_channels"]

# folder below src/: (unit tests, system tests)
FOLDERS = {
    "drive": (["test_drive", "test_explore", "test_cycle"], SYSTEMS),
    "cycle": (["test_cycle", "test_explore"], SYSTEMS),
    "profile": (["test_profile", "test_drive", "test_transport", "test_cycle", "test_explore"], SYSTEMS),
    "robot": (["test_robot", "test_cycle"], SYSTEMS),
    "profibus": (["test_profibus", "test_transport", "test_transport_scan", "test_explore"], ["test_system", "test_system_channels"]),
    "canopen": (["test_canopen", "test_transport", "test_transport_scan", "test_explore"], ["test_system_canopen"]),
    "devicenet": (["test_devicenet", "test_transport", "test_transport_scan", "test_explore"], ["test_system_devicenet"]),
    "interbus": (["test_interbus", "test_transport_interbus"], ["test_system_interbus"]),
}

# Percent of the drawn mutants that have to be found; those judged equivalent count as neither.
GOALS = {"drive": 95, "cycle": 95, "profile": 95, "robot": 95, "profibus": 90, "canopen": 90, "devicenet": 90, "interbus": 90}


def programsOf(folders, only_units=False):
    """Every program that is asked about one of the folders, each once."""
    found = []
    for folder in folders:
        units, systems = FOLDERS[folder]
        found += [program for program in units + ([] if only_units else systems) if program not in found]
    return found
