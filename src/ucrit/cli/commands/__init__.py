"""One module for each command, called as the command is; imported when it is used."""
