"""What is wrong in a bag: damage, silences, stamps that go back."""
