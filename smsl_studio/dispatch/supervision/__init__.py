"""Supervision: the commands of people and agents, their run states, and their effects."""
