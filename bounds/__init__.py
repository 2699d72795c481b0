"""What does the theory promise? Closed forms, theorems as objects, planning (k, r)."""
