"""What a laboratory withholds, made up: every cause in one record of two."""


def made_up_truth(explanation=(), stratum=None, detectability=15.0, mimics="", localised=False, everywhere=True):
    stratum = stratum or ("none" if not explanation else "single" if len(explanation) == 1 else "pair")
    causes = [
        {
            "effect": name,
            "records": ["a"],
            "everywhere": everywhere,
            "localised": localised,
            "left_by_best_other": detectability,
            "windows": [{"record": "a", "time_s": [20.0, 60.0], "true_strain": [0.1, 0.3]}],
        }
        for name in explanation
    ]
    return {
        "stratum": stratum,
        "seed": 3,
        "explanation": list(explanation),
        "mimics": mimics,
        "detectability": detectability if explanation else 0.0,
        "causes": causes,
        "oracle": {"right": 1.0, "resolvable": True, "posterior": {"+".join(explanation): 1.0}},
        "records": {
            "a": {"duration_s": 100.0, "history": "ramp", "role": "identify"},
            "b": {"duration_s": 50.0, "history": "ramp", "role": "identify"},
        },
        "base": {"unrelaxed_modulus_MPa": 2000.0},
    }
