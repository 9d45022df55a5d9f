"""`python -m svt ARGUMENTS` is the command `svt ARGUMENTS`."""
from .command import main

main()
