"""The monitor: it makes facts, with age and reason, from the samples of sensors (paper, Eq. 5
``C_fact``, and State Monitoring Wireless Sensor Network)."""
