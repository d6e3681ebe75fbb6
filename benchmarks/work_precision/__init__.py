"""Error against cost of every scene, over the knobs that matter in it.

    python -m benchmarks.work_precision [--quick] [--out FOLDER] [--only SCENE ...]

    scenes     what is run, which knobs are turned, where the truth comes from
    measure    one row: a run in this process, its CPU time, its error
    chart      a picture a scene, the table of the defaults

Rows are kept in work_precision.csv as they come; a second call goes on where the first was ended.
"""
