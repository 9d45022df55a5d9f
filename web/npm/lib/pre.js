// Before the module starts: its environment is that of the system.
Module['preRun'] = [() => Object.assign(ENV, Module['host']['environment'])];
