"""Where operations run, tick by tick, so that the dispatcher outlives them."""
