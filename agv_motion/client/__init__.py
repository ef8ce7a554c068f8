"""A robot in somebody's script: go there, wait, ask, cancel; see the README of this room."""

from agv_motion.client.robot import Robot

__all__ = ['Robot']
