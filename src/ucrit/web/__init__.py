"""The explorer: a page in the browser, served to this machine alone, that asks the same door as the command line.

`serve` starts it, `routes` lists what the page may ask, `guard` turns away who may not ask, `subject` reads a
request, `answers` and `downloads` answer it. Nothing is kept between two requests: each carries its whole vehicle.
"""
