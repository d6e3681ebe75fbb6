"""What holds of every scene, gas, option and file: looked for with random ones.

`python -m tests.properties` is the full search, of thousands; CI runs a small part of it, always
the same. A case that fails is made as small as possible, and printed.
"""
