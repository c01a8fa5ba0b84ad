"""Sites of sensor nodes: the site file, logins, what a broker must know, and programs that play
nodes.

``site_file`` reads who speaks for which fact. ``new_site`` makes keys, certificates and rights.
"""
